#include <fstream>

#include "experiments/workbench/pages/gallery.h"

#include "experiments/workbench/app/manifest_file.h"
#include "experiments/workbench/pages/gallery_exhibit.h"
#include "experiments/workbench/pages/manifest.h"
#include "experiments/workbench/pages/report.h"
#include "experiments/workbench/session/record.h"
#include "render/image.h"
#include "tests/experiments/program.h"

namespace hysteron::experiments {
namespace {

void write_text(const fs::path& file, const std::string& text) {
  fs::create_directories(file.parent_path());
  std::ofstream(file) << text;
}

void write_picture(const fs::path& file, int width, int height) {
  fs::create_directories(file.parent_path());
  render::Image picture(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) picture.at(x, y)[0] = static_cast<std::uint8_t>(255 * x / width);
  render::write_png(file, picture);
}

// Writes a finished run of `experiment` with one metric.
void write_run(const fs::path& folder, const std::string& experiment, double metric = 49.8) {
  ExperimentRun run({experiment, "hysteron " + experiment + " --quick", {}, {}}, setup_in(folder));
  run.manifest().device = "cpu: CPU, 2 threads";
  run.metric("recovery_angle_deg", metric);
  run.metric("newton_iterations_per_step", 3);
  run.finish();
}

class Gallery : public testing::Test {
 protected:
  Gallery() {
    write_run(results_ / "a-kes", "kes");
    write_run(results_ / "z-drape", "drape");
    write_picture(results_ / "z-drape/sheet.png", 1800, 300);
    write_picture(results_ / "z-drape/plot_energy.png", 400, 100);
    write_text(results_ / "z-drape/plot_energy.svg", "<svg xmlns=\"http://www.w3.org/2000/svg\"/>");
    write_run(results_ / "stability/bdf2", "stability");
    write_text(results_ / "speed/bench.json", R"([{"law":"linear","device":"cpu","ms_per_step":2.5},
                                                   {"law":"wong","device":"cpu","ms_per_step":2.625}])");
    write_text(results_ / "README.md", "# Results\n");
  }
  std::string page() const { return gallery_page(results_); }
  // The message of the error that the page ends in.
  std::string refusal() const {
    return test::refusal([&] { page(); });
  }

  Folder folder_;
  fs::path results_ = folder_.path() / "results";
};

TEST_F(Gallery, GroupsRunsByExperimentInTheOrderOfAReader) {
  std::vector<std::string> experiments, names;
  for (const ExhibitGroup& group : exhibits_in(results_)) {
    experiments.push_back(group.experiment);
    for (const Exhibit& exhibit : group.exhibits) names.push_back(exhibit.name);
  }
  EXPECT_EQ(experiments, (std::vector<std::string>{"drape", "kes", "stability", "speed"}));
  EXPECT_EQ(names, (std::vector<std::string>{"z-drape", "a-kes", "stability/bdf2", "speed"}));
}

TEST_F(Gallery, ListsEveryExhibitInItsContentsAndLeadsThere) {
  const std::string html = page();
  for (const char* anchor : {"z-drape", "a-kes", "stability-bdf2", "speed"}) {
    EXPECT_EQ(occurrences(html, "id=\"" + std::string(anchor) + "\""), 1) << anchor;
    EXPECT_GE(occurrences(html, "href=\"#" + std::string(anchor) + "\""), 2) << anchor;
  }
}

TEST_F(Gallery, NamesTheCommandTheDeviceTheMetricAndTheManifest) {
  const std::string html = page();
  for (const char* part : {"hysteron drape --quick", "cpu: CPU, 2 threads", "49.8", "recovery angle",
                           "href=\"z-drape/manifest.json\"", "Cusick"}) {
    EXPECT_TRUE(says(html, part));
  }
}

TEST_F(Gallery, SaysWhatRunsWarnOf) {
  EXPECT_EQ(occurrences(page(), "class=\"note\""), 0);
  {
    ExperimentRun run({"drape", "hysteron drape", {}, {}}, setup_in(results_ / "doubtful"));
    run.metric("recovery_angle_deg", 49.8);
    run.warn("layers < 2 are thin");
    run.warn("edges are folded");
    run.finish();
  }
  EXPECT_EQ(
      occurrences(page(), "<p class=\"note\">Warning: layers &lt; 2 are thin; 1 more in manifest.json</p>"),
      1);
}

// A manifest keeps the words of the program that wrote it; the page does not repeat what is known to be
// wrong.
TEST_F(Gallery, SaysTodayWhatEarlierProgramsSaidOfSharpFolds) {
  {
    ExperimentRun run({"drape", "hysteron drape", {}, {}}, setup_in(results_ / "folded"));
    run.metric("recovery_angle_deg", 49.8);
    run.warn(
        "up to 8.0 % of the edges were folded by more than 0.5 rad, where bending is more than 2.5 % too "
        "soft: take more triangles");
    run.finish();
  }
  const std::string html = page();
  EXPECT_FALSE(says(html, "too soft"));
  EXPECT_TRUE(says(
      html, "8.0 % of the edges were folded by more than 0.5 rad, where triangles are coarse for the fold"));
}

TEST_F(Gallery, SaysWhichRunsAreIncomplete) {
  EXPECT_EQ(occurrences(page(), ">incomplete<"), 0);
  { ExperimentRun run({"drape", "hysteron drape", {}, {}}, setup_in(results_ / "broken-off")); }
  EXPECT_EQ(occurrences(page(), ">incomplete<"), 1);
}

TEST(GalleryAbout, NamesFewLawsAndCountsMany) {
  const auto subject = [](const char* scene) {
    return scene_subject(parsed_manifest({{"scene", json_in(scene, "scene")}}));
  };
  EXPECT_EQ(subject(R"({"fabric": {"name": "wool"}, "law": "prandtl"})"), "wool, law prandtl");
  EXPECT_EQ(subject(R"({"fabric": {"name": "wool"}, "law": "dahl,wong"})"), "wool, laws dahl, wong");
  EXPECT_EQ(subject(R"({"fabrics": "wool", "laws": ["a", "b", "c", "d", "e"]})"), "wool, 5 laws");
  EXPECT_EQ(subject(R"({"fabrics": "a,b,c,d,e", "laws": "linear"})"), "5 fabrics, law linear");
  EXPECT_EQ(subject("{}"), "");
}

TEST_F(Gallery, ShowsADrawingInsteadOfThePictureOfIt) {
  const std::string html = page();
  EXPECT_EQ(occurrences(html, "src=\"z-drape/plot_energy.svg\""), 1);
  EXPECT_EQ(occurrences(html, "href=\"z-drape/plot_energy.svg\""), 1);
  write_text(results_ / "z-drape/plot_energy.svg", "<svg>" + std::string(100000, ' ') + "</svg>");
  const std::string heavy = page();
  EXPECT_EQ(occurrences(heavy, "src=\"z-drape/plot_energy.svg\""), 0);
  EXPECT_EQ(occurrences(heavy, "src=\"z-drape/plot_energy.png\""), 1);
  EXPECT_EQ(occurrences(heavy, "href=\"z-drape/plot_energy.svg\""), 1) << "linked";
}

TEST_F(Gallery, LeadsToTablesAndLists) {
  write_text(results_ / "tables/large.csv", "x\n7123\n");
  const std::string html = page();
  for (const char* part : {"href=\"tables/large.csv\"", "href=\"speed/bench.json\""})
    EXPECT_EQ(occurrences(html, part), 1) << part;
  EXPECT_EQ(occurrences(html, "7123"), 0);
}

TEST_F(Gallery, TakesTheRunsBelowARunAsItsParts) {
  write_run(results_ / "z-drape/wong", "drape", 12.5);
  write_picture(results_ / "z-drape/wong/sheet.png", 60, 40);
  EXPECT_EQ(exhibits_in(results_)[0].exhibits.size(), 1u);
  const std::string html = page();
  EXPECT_EQ(occurrences(html, "href=\"z-drape/wong/manifest.json\""), 1);
  EXPECT_EQ(occurrences(html, "href=\"z-drape/wong/sheet.png\""), 1);
  EXPECT_TRUE(says(html, "Wong: contact sheet: "));
}

TEST_F(Gallery, PlaysFramesThatAreThere) {
  EXPECT_EQ(occurrences(page(), "class=\"player\""), 0);
  for (int i = 0; i < 30; ++i)
    write_picture(results_ / "z-drape/frames" / (std::to_string(1000 + i) + ".png"), 32, 18);
  const std::string html = page();
  EXPECT_EQ(occurrences(html, "class=\"player\""), 1);
  EXPECT_EQ(occurrences(html, "alt=\"frames/"), 12);
  EXPECT_EQ(occurrences(html, "alt=\"frames/1000.png\""), 1);
  EXPECT_EQ(occurrences(html, "alt=\"frames/1029.png\""), 1);
}

// Sequences in other looks, and a comparison's film, are no exhibits.
TEST_F(Gallery, PassesOverOtherSequences) {
  const int before = occurrences(page(), "<figure>");
  for (const char* folder : {"frames-silhouette", "film"})
    write_picture(results_ / "z-drape" / folder / "0000.png", 32, 18);
  EXPECT_EQ(occurrences(page(), "<figure>"), before);
}

TEST_F(Gallery, TakesCaptionsThatTheRunWrote) {
  write_text(results_ / "z-drape/README.md",
             "# Drape\n\n![The sheet](sheet.png)\n\n**The sheet.** Let down by `a plate`.\n");
  EXPECT_TRUE(says(page(), "<figcaption>The sheet. Let down by a plate.</figcaption>"));
}

TEST_F(Gallery, OpensWithThePictureThatTheReadmeBesideItShowsFirst) {
  EXPECT_EQ(occurrences(page(), "class=\"teaser\""), 0);
  write_text(folder_.path() / "README.md", "# Cloth\n\n![One cloth](results/z-drape/sheet.png)\n");
  const std::string html = page(),
                    teaser = "<figure class=\"teaser\"><a class=\"zoom\" href=\"z-drape/sheet.png\">";
  EXPECT_EQ(occurrences(html, teaser), 1);
  EXPECT_LT(html.find(teaser), html.find("<nav"));
  EXPECT_EQ(occurrences(html, "<figcaption>One cloth</figcaption>"), 1);
  write_text(folder_.path() / "README.md", "![elsewhere](../secret/sheet.png)\n");
  EXPECT_EQ(occurrences(page(), "class=\"teaser\""), 0);
}

// Five questions stand before everything else, each with its picture and the number from its run.
TEST_F(Gallery, LeadsWithTheFoldersOwnQuestions) {
  const auto write = [&](const std::string& picture, const std::string& metric) {
    write_text(results_ / "questions.json", R"([{"question": "Does it hang?", "picture": ")" + picture +
                                                R"(", "run": "z-drape", "metric": ")" + metric +
                                                R"(", "words": "of recovery"}])");
  };
  write("z-drape/sheet.png", "recovery_angle_deg");
  const std::string html = page();
  EXPECT_LT(html.find("<h2>Does it hang?</h2>"), html.find("<section id="));
  EXPECT_TRUE(says(html, "of recovery <a href=\"#z-drape\">z-drape</a>")) << html;
  EXPECT_TRUE(says(html, "<b>49.8"));
  write("z-drape/none.png", "recovery_angle_deg");
  EXPECT_TRUE(says(refusal(), "there is no picture z-drape/none.png"));
  write("z-drape/sheet.png", "none");
  EXPECT_TRUE(says(refusal(), "has no metric none"));
  write_text(results_ / "questions.json", "{}");
  EXPECT_TRUE(says(refusal(), "must be a list of questions"));
}

// Each run is a card with its picture and number; what has neither is a line of links.
TEST_F(Gallery, IsAnIndexOfCardsThatUnfold) {
  const std::string html = page();
  EXPECT_EQ(occurrences(html, "<details class=\"exhibit\">"), 3);
  EXPECT_EQ(occurrences(html, "<details class=\"exhibit\"><summary><img"), 1) << "only z-drape has a picture";
  EXPECT_TRUE(says(html, "<p class=\"files\" id=\"speed\">"));
}

TEST_F(Gallery, IsTheSameWhereverItLies) {
  const std::string html = page();
  EXPECT_EQ(page(), html);
  fs::copy(results_, folder_.path() / "copy", fs::copy_options::recursive);
  EXPECT_EQ(gallery_page(folder_.path() / "copy"), html);
}

TEST_F(Gallery, IsNotBrokenByOddNames) {
  write_run(results_ / "a <b> & \"c\" #1", "drape");
  const std::string html = page();
  EXPECT_EQ(occurrences(html, "<b> &"), 0);
  EXPECT_TRUE(says(html, "a &lt;b&gt; &amp; &quot;c&quot; #1"));
  EXPECT_TRUE(says(html, "href=\"a%20%3Cb%3E%20%26%20%22c%22%20%231/manifest.json\""));
}

TEST_F(Gallery, NamesABrokenPicture) {
  write_text(results_ / "a-kes/plot_loops.png", "\x89PNG\r\n\x1a\nhalf");
  EXPECT_TRUE(says(refusal(), "results/a-kes/plot_loops.png: not a PNG picture"));
}

TEST_F(Gallery, NamesABrokenManifest) {
  const std::string whole = file_content(results_ / "a-kes/manifest.json");
  write_text(results_ / "a-kes/manifest.json", whole.substr(0, whole.size() / 2));
  EXPECT_TRUE(says(refusal(), "results/a-kes/manifest.json is damaged: it was cut off"));
  write_text(results_ / "a-kes/manifest.json",
             R"({"hysteron":{"version":"0","commit":"0"},"scene":{},"experiment":"kes","started":7})");
  EXPECT_TRUE(says(refusal(), "results/a-kes/manifest.json is no manifest"));
}

// A manifest that lacks a key, or has one of another type, is named with the key and in words.
TEST_F(Gallery, SaysWhatIsWrongWithAManifest) {
  const fs::path file = results_ / "a-kes/manifest.json";
  const Json whole = read_json(file);
  const auto says = [&](const char* path, const Json& value, const std::string& problem) {
    Json changed = whole;
    changed[Json::json_pointer(path)] = value;
    write_text(file, changed.dump());
    EXPECT_EQ(refusal(), file.string() + " is no manifest of hysteron: " + problem);
  };
  says("/metrics", "many", "metrics is a text, must be an object");
  says("/wall_seconds", 7, "wall_seconds is a number, must be an object");
  says("/wall_seconds/total", "long", "wall_seconds.total is a text, must be a number");
  says("/seconds_simulated", Json::array(), "seconds_simulated is a list, must be a number");
  says("/complete", 1, "complete is a number, must be true or false");
  says("/scene/fabric", "cotton", "scene.fabric is a text, must be an object");
  says("/scene/laws", {"linear", 7}, "scene.laws holds a number where a name must be");
  says("/scene/fabric/provenance", {{"b1", {{"source", "kes"}}}},
       "scene.fabric.provenance has an entry without confidence");
  says("/frames", {{"moments", {{{"s", "now"}}}}}, "frames.moments has a time s that is no number");
  write_text(file, R"({"hysteron":{"version":"0"}})");
  EXPECT_EQ(refusal(), file.string() + " is no manifest of hysteron: it has no hysteron.commit");
  write_text(file, std::string(100000, '['));
  EXPECT_EQ(refusal(), file.string() + " is no manifest of hysteron: it nests more than 64 deep");
}

TEST_F(Gallery, PassesOverLinksThatLeadNowhereAndRefusesThoseThatLeadBack) {
  const std::string before = page();
  for (const char* name :
       {"loop", "a-kes/loop", "a-kes/loop.png", "z-drape/README.md", "z-drape/metrics.csv"})
    fs::create_symlink(fs::path(name).filename(), results_ / name);
  EXPECT_EQ(page(), before);
  fs::create_directory_symlink("../..", results_ / "z-drape/above");
  EXPECT_EQ(refusal(), (results_ / "z-drape/above").string() + " is a link back to " +
                           folder_.path().string() + ": remove it");
  fs::remove(results_ / "z-drape/above");
  fs::remove(results_ / "a-kes/manifest.json");
  fs::create_symlink("manifest.json", results_ / "a-kes/manifest.json");
  EXPECT_FALSE(says(page(), "a-kes/manifest.json"));
}

TEST_F(Gallery, OfNothingIsAWrongRequest) {
  fs::remove_all(results_);
  fs::create_directories(results_ / "empty/frames");
  EXPECT_TRUE(says(refusal(), "nothing to show in"));
}

std::vector<std::string> stale_names(const fs::path& folder) {
  std::vector<std::string> names;
  for (const StalePage& page : stale_pages(folder))
    names.push_back(fs::relative(page.page, folder).string() + (page.missing ? " missing" : ""));
  return names;
}

TEST_F(Gallery, IsStaleOnceARunSaysSomethingElse) {
  EXPECT_EQ(stale_names(results_), (std::vector<std::string>{"index.html missing"}));
  EXPECT_EQ(write_gallery(results_), results_ / "index.html");
  EXPECT_EQ(stale_names(results_), std::vector<std::string>{});
  write_run(results_ / "a-kes", "kes", 50.0);
  EXPECT_EQ(stale_names(results_), (std::vector<std::string>{"index.html"}));
}

TEST_F(Gallery, ChecksThePagesOfItsRunsToo) {
  write_report(results_ / "a-kes");
  write_gallery(results_);
  EXPECT_EQ(stale_names(results_), std::vector<std::string>{});
  std::ofstream(results_ / "a-kes/report.html", std::ios::app) << " ";
  EXPECT_EQ(stale_names(results_), (std::vector<std::string>{"a-kes/report.html"}));
}

TEST_F(Gallery, OfTheProgramSaysHowToRefreshAStalePage) {
  const std::string results = results_.string();
  EXPECT_EQ(finished("report " + results + "/").err, "");
  EXPECT_EQ(finished("report --check " + results).err, "");
  write_run(results_ / "a-kes", "kes", 50.0);
  const Outcome stale = ended(4, "report --check " + results);
  EXPECT_EQ(stale.err, "hysteron report: " + results + "/index.html is not what its folder says now; write " +
                           "it again: hysteron report " + results + "\n");
  refused("report " + results + "/nowhere");
}

}  // namespace
}  // namespace hysteron::experiments
