// Pages that link their pictures, and pages that hold them.
#include <fstream>
#include <regex>

#include "experiments/workbench/pages/gallery.h"
#include "experiments/workbench/pages/page.h"
#include "experiments/workbench/pages/pictures.h"
#include "experiments/workbench/pages/report.h"
#include "render/image.h"
#include "tests/experiments/program.h"

namespace hysteron::experiments {
namespace {

// Returns the values of an attribute, in the order of the page.
std::vector<std::string> attribute_values(const std::string& html, const std::string& name) {
  const std::string begin = " " + name + "=\"";
  std::vector<std::string> values;
  for (std::size_t at = 0; (at = html.find(begin, at)) != html.npos;) {
    at += begin.size();
    values.push_back(html.substr(at, html.find('"', at) - at));
  }
  return values;
}

std::string url_path(const std::string& url) {
  std::string path;
  for (std::size_t i = 0; i < url.size(); ++i) {
    const bool coded = url[i] == '%';
    path += coded ? static_cast<char>(std::stoi(url.substr(i + 1, 2), nullptr, 16)) : url[i];
    if (coded) i += 2;
  }
  return path;
}

bool leads_to_a_place(const std::string& url) { return url.starts_with('#'); }

// Every picture is a file below the page, and so is every other link.
void expect_all_there(const std::string& html, const fs::path& folder) {
  ASSERT_FALSE(says(html, "=\"data:"));
  for (const char* name : {"src", "href"}) {
    for (const std::string& url : attribute_values(html, name)) {
      if (leads_to_a_place(url)) continue;
      EXPECT_EQ(url.find_first_of(":?#&+= "), url.npos) << url;
      EXPECT_TRUE(fs::is_regular_file(folder / url_path(url))) << url;
    }
  }
}

void expect_alone(const std::string& html) {
  for (const std::string& url : attribute_values(html, "src"))
    EXPECT_TRUE(url.starts_with("data:image/")) << url;
  for (const std::string& url : attribute_values(html, "href")) EXPECT_TRUE(leads_to_a_place(url)) << url;
  for (const char* part : {"<link", "<script src", "url(", "@import"}) EXPECT_FALSE(says(html, part));
}

void write_pictures(const fs::path& folder) {
  fs::create_directories(folder / "frames");
  render::write_png(folder / "sheet.png", render::Image(1800, 300, render::Rgb8{200, 10, 10}));
  for (const char* frame : {"0000.png", "0001.png"})
    render::write_png(folder / "frames" / frame, render::Image(600, 100, render::Rgb8{10, 200, 10}));
  std::ofstream(folder / "plot_energy.svg")
      << "<svg\n width=\"1200\" height=\"800\" xmlns=\"http://www.w3.org/2000/svg\"/>";
  render::write_png(folder / "plot_energy.png", render::Image(120, 80, render::Rgb8{10, 10, 200}));
}

void write_run(const fs::path& folder) {
  ExperimentRun run(drape_line(), setup_in(folder));
  write_pictures(folder);
  run.finish();
}

// The fixture has a gallery of a run with a part, a folder without a run, and a list of manifests.
class PageForms : public testing::Test {
 protected:
  PageForms() {
    write_run(run_);
    write_run(run_ / "wong 100% #1");
    fs::create_directories(results_ / "pictures");
    fs::copy(run_ / "sheet.png", results_ / "pictures/Stoff \xc3\xbc.png");
    fs::create_directories(results_ / "scenes");
    fs::copy(run_ / "manifest.json", results_ / "scenes/square+half.json");
    std::ofstream(results_ / "scenes/a=b.csv") << "law,step_ms\nwong,2.5\ndahl,3.5\n";
  }

  Folder folder_;
  fs::path results_ = folder_.path() / "results", run_ = results_ / "linear+fabric.damping=0.004783";
};

TEST_F(PageForms, ByDefaultEveryPictureOfARunIsAFileThatExists) {
  const std::string html = file_content(write_report(run_));
  expect_all_there(html, run_);
  EXPECT_EQ(attribute_values(html, "src"),
            (std::vector<std::string>{"sheet.png", "plot_energy.svg", "frames/0000.png", "frames/0001.png"}));
}

TEST_F(PageForms, ASelfContainedPageRefersToNoFile) {
  const std::string gallery = gallery_page(results_, PageForm::self_contained);
  expect_alone(gallery);
  EXPECT_EQ(attribute_values(gallery, "src").size(), attribute_values(gallery_page(results_), "src").size());
  const std::string report = file_content(write_report(run_, PageForm::self_contained));
  expect_alone(report);
  EXPECT_EQ(attribute_values(report, "src").size(), 4u);
}

TEST_F(PageForms, ASelfContainedGalleryHoldsPicturesShrunk) {
  const auto small = thumbnail(run_ / "sheet.png", 900);
  const render::Image sheet = render::decode_png(small, "the sheet");
  EXPECT_EQ(sheet.width(), 900);
  EXPECT_EQ(sheet.height(), 150);
  const std::string html = gallery_page(results_, PageForm::self_contained);
  EXPECT_TRUE(says(html, "src=\"data:image/png;base64," + base64(small) + "\""));
}

TEST_F(PageForms, OfTheProgramAreLinkedUnlessAskedForAlone) {
  const std::string results = results_.string(), page = results + "/index.html";
  const Outcome alone = finished("report " + results + " --self-contained");
  EXPECT_EQ(alone.out, page + "\n");
  expect_alone(file_content(page));
  ended(4, "report --check " + results);  // the default form is compared
  finished("report " + results);
  expect_all_there(file_content(page), results_);
  finished("report --check " + results);
  EXPECT_EQ(refused("report --check --self-contained " + results),
            "hysteron report: --check is of pages that link their pictures: leave out --self-contained\n");
}

TEST(DrawingSize, IsKnownWhereTheFirstTagSaysIt) {
  const Folder folder;
  const fs::path file = folder.path() / "a.svg";
  const auto size = [&](const std::string& text) {
    std::ofstream(file) << text;
    return drawing_size(file);
  };
  EXPECT_EQ(size("<?xml version=\"1.0\"?>\n<svg\n width=\"1200\" height=\"80\">"),
            (render::ImageSize{1200, 80}));
  EXPECT_EQ(size("<svg stroke-width=\"3\" width=\"40\" height=\"20\">"), (render::ImageSize{40, 20}));
  for (const char* text : {"", "<svg", "<svg>", "<svg width=\"12cm\" height=\"8cm\">", "<svg width=\"40\">",
                           "<svg width=\"99999999999\" height=\"1\">", "<svg><a width=\"1\" height=\"1\">"})
    EXPECT_EQ(size(text), render::ImageSize{}) << text;
}

// It is committed again with every new run.
TEST(Results, PageIsBelow300KilobytesAndItsPicturesExist) {
  const fs::path results = HYSTERON_RESULTS;
  EXPECT_LT(fs::file_size(results / "index.html"), 300000u);
  expect_all_there(file_content(results / "index.html"), results);
}

TEST(Results, NameNoFolderOfTheMachineThatMadeThem) {
  const std::regex absolute(R"(["\s=]/\w+/)");
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(HYSTERON_RESULTS)) {
    if (entry.path().extension() != ".json") continue;
    const std::string text = file_content(entry.path());
    std::smatch found;
    EXPECT_FALSE(std::regex_search(text, found, absolute)) << entry.path() << ":" << found.str();
  }
}

}  // namespace
}  // namespace hysteron::experiments
