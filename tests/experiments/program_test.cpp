// The program as a script meets it: exit codes, one line on stderr, results on stdout.
#include <algorithm>
#include <fstream>
#include <map>
#include <sstream>

#include "sim/mesh/cloth_mesh.h"
#include "sim/scene/assets.h"
#include "sim/scene/fabric_reader.h"
#include "tests/experiments/program.h"

namespace hysteron::experiments {
namespace {

TEST(Program, NamesTheExperimentOnceInAMessage) {
  EXPECT_EQ(program("law --b1 -1 --in a --out b").err, "hysteron law: b1 = -1 N m must be >= 0 (--b1)\n");
  EXPECT_EQ(program("law --lw x").err, "hysteron law: unknown option --lw; did you mean --law?\n");
  EXPECT_EQ(program("lwa").err, "hysteron: unknown subcommand lwa; did you mean law?\n");
}

TEST(Program, ExitsWithTwoForAWrongRequestAndOneForAFailingMachine) {
  refused("law --b1 -1 --in a --out b");
  refused("");
  ended(1, "list fabrics >/dev/full #");
  for (const char* words : {"--version", "drape --help", "--help"}) {
    ended(1, std::string(words) + " >/dev/full #");
  }
}

// Beside another program on its cores a run would take many times as long otherwise.
TEST(Program, LetsThreadsThatWaitSpinShortlyUnlessItsUserSaysHow) {
  const Folder folder;
  const auto said = [&](const std::string& environment) {
    const std::string err = folder.path() / "err";
    const std::string command = "env -u OMP_WAIT_POLICY -u GOMP_SPINCOUNT " + environment +
                                " OMP_DISPLAY_ENV=verbose " HYSTERON_PROGRAM " --version >/dev/null 2>" + err;
    EXPECT_EQ(std::system(command.c_str()), 0);
    return file_content(err);
  };
  EXPECT_NE(said("").find("GOMP_SPINCOUNT = '10000'"), std::string::npos);
  EXPECT_EQ(said("GOMP_SPINCOUNT=77").find("'10000'"), std::string::npos);
  EXPECT_EQ(said("OMP_WAIT_POLICY=active").find("'10000'"), std::string::npos);
}

TEST(Program, RefusesRunsThatWouldDoNothing) {
  const Folder folder;
  const std::string out = " --quiet --no-images" + out_flag(folder.path() / "out");
  const auto refusal = [&](const std::string& words) {
    const std::string said = refused(words + out);
    EXPECT_FALSE(fs::exists(folder.path() / "out")) << words;
    return said;
  };
  for (const char* name : {"swing", "drape"})
    EXPECT_EQ(
        refusal(std::string(name) + " --step 0.5 --seconds 0.1"),
        std::string("hysteron ") + name + ": step = 0.5 s (--step) must be <= seconds = 0.1 s (--seconds)\n");
  EXPECT_EQ(refusal("drape --drape.disc 0.2"),
            "hysteron drape: drape.disc = 0.2 m must be < cloth.radius = 0.15 m\n");
}

TEST(Program, SaysInOneLineThatAPathLeadsToItself) {
  const Folder folder;
  const std::string loop = (folder.path() / "loop").string();
  fs::create_symlink("loop", loop);
  EXPECT_EQ(program("report " + loop).err, "hysteron report: no folder " + loop + "\n");
  EXPECT_EQ(program("diff " + loop + " " + loop).err,
            "hysteron diff: cannot use " + loop + ": Too many levels of symbolic links\n");
  fs::create_symlink("manifest.json", folder.path() / "manifest.json");
  EXPECT_EQ(program("report " + folder.path().string()).err, "hysteron report: cannot read " +
                                                                 (folder.path() / "manifest.json").string() +
                                                                 ": Too many levels of symbolic links\n");
}

TEST(Program, NeedsNoHomeAndNoPlaceForTemporaryFiles) {
  const Folder folder;
  const std::string out = (folder.path() / "out").string(), err = (folder.path() / "err").string();
  const std::string line = "env -u HOME TMPDIR=/nonexistent " HYSTERON_PROGRAM
                           " swing --quick --triangles 40 --seconds 0.02 --no-images --quiet --out " +
                           out + " >/dev/null 2>" + err;
  EXPECT_EQ(std::system(line.c_str()), 0) << file_content(err);
  EXPECT_EQ(without_warnings(file_content(err)), "");
}

// Long sources were shortened wrongly in these ways: two authors as one, sentences without their ends,
// "assumed: assumed".
TEST(Program, ListsSourcesOfFabricsByTheirShortNames) {
  const std::string table = program("list fabrics").out;
  for (const std::string& name : list_assets("fabrics")) {
    const FabricFile file = read_fabric(name, "test");
    const std::size_t at = table.find("\n" + name + " ");
    ASSERT_NE(at, std::string::npos) << name;
    const std::string line = table.substr(at + 1, table.find('\n', at + 1) - at - 1);
    const bool by_its_short_name =
        std::any_of(file.short_names.begin(), file.short_names.end(),
                    [&](const auto& source) { return line.ends_with(" " + source.second); });
    EXPECT_TRUE(by_its_short_name) << line;
  }
  for (const char* part : {"found such that", "assumed: assumed", "Kumari et al.", "2313"})
    EXPECT_FALSE(says(table, part));
  for (const char* part : {"Kumari, Khurana 2016", "(fitted: Fashion and Textiles 2017)", "Wang et al. 2011"})
    EXPECT_TRUE(says(table, part));
}

// Where EGL finds no driver, it is listed with what fails.
TEST(Program, ListsDevicesWithWhatFailsWhenTheyAreOpened) {
  const auto renderers = [](const std::string& environment) {
    std::vector<nlohmann::json> list;
    const Folder folder;
    const fs::path out = folder.path() / "out";
    std::system((environment + " " HYSTERON_PROGRAM " list devices --json >" + out.string() + " 2>/dev/null")
                    .c_str());
    const auto lists = read_json(out);
    for (const auto& device : lists.at("devices"))
      if (device.contains("renderer")) list.push_back(device);
    return list;
  };
  const auto all = renderers("");
  ASSERT_FALSE(all.empty());
  for (const auto& renderer : all)
    EXPECT_NE(renderer.contains("reason"), renderer.at("name").is_string()) << renderer;
  const auto without_driver = renderers("__EGL_VENDOR_LIBRARY_FILENAMES=/nowhere");
  ASSERT_FALSE(without_driver.empty());
  EXPECT_TRUE(std::any_of(without_driver.begin(), without_driver.end(), [](const auto& renderer) {
    return renderer.contains("reason") && !renderer.at("reason").template get<std::string>().empty();
  })) << nlohmann::json(without_driver);
}

TEST(Program, ListsEveryNumberOfAFabricWithHowItIsKnown) {
  const Outcome outcome = finished("list fabrics wool-tropical-k50");
  std::map<std::string, std::string> row;  // by its first word
  std::istringstream lines(outcome.out);
  for (std::string line; std::getline(lines, line);) row[line.substr(0, line.find(' '))] = line;
  EXPECT_TRUE(says(row["b2"], "6.57e-06"));
  EXPECT_TRUE(says(row["b2"], "published"));
  EXPECT_TRUE(says(row["k0"], "assumed    12.5 to 50"));
  EXPECT_TRUE(says(row["drape-coefficient"], "49.8"));
  refused("list fabrics silk-of-nowhere");
}

TEST(Program, ListsAsJsonWhatItListsAsText) {
  const Outcome outcome = finished("list --json");
  const auto lists = json_in(outcome.out, "stdout");
  for (const char* list : {"fabrics", "laws", "scenes", "devices"})
    EXPECT_FALSE(lists.at(list).empty()) << list;
  const auto wool =
      json_in(program("list fabrics wool-tropical-k50 --json").out, "stdout").at("fabrics").at(0);
  EXPECT_EQ(wool.at("numbers").at("k0").at("range"), Json({12.5, 50}));
  EXPECT_EQ(wool.at("numbers").at("b2").at("known"), "published");
  EXPECT_EQ(wool.at("published").at("drape-coefficient").at("value"), 49.8);
}

TEST(Program, SaysItsVersionAndCommit) {
  const Outcome outcome = finished("--version");
  EXPECT_TRUE(says(outcome.out, "(commit "));
  for (const char* words : {"drape --version", "list laws --version", "drape --quick --step 0.1 --version"})
    EXPECT_EQ(finished(words).out, outcome.out) << words;
}

// A box appears around the sheet at 0.3 s.
TEST(Program, ExitsWithThreeWhereARunCannotGoOnAndKeepsWhatWasWritten) {
  const Folder folder;
  const fs::path out = folder.path() / "boxed";
  const std::string scene = folder.write("boxed.toml", R"(integrator = "implicit"
step = 0.004
triangles = 60
seconds = 0.5
cloth = {length = 0.1, position = [0, 0, 0.0005]}
[[pin]]
select = "nearest"
[[obstacle]]
[[obstacle]]
kind = "box"
size = [0.2, 0.2, 0.01]
center = [0.05, 0.05, 0]
from = 0.3
)");
  const Outcome outcome = ended(3, "swing --no-images --quiet --fps 50 --scene " + scene + out_flag(out));
  EXPECT_TRUE(says(outcome.err, "hysteron swing: at t = 0.3"));
  EXPECT_TRUE(says(outcome.err, "an obstacle appears where the cloth is: vertex "));
  const Json manifest = manifest_in(out);
  EXPECT_EQ(manifest["complete"], false);
  const std::string table = file_content(out / "metrics.csv");
  EXPECT_GT(std::count(table.begin(), table.end(), '\n'), 15);  // moments before 0.3 s
}

TEST(Program, WritesNoMomentsOntoItsCurvatures) {
  const Folder folder;
  const std::string in = folder.write("k.csv", "curvature [1/m]\n50\n"), link = folder.file("link.csv");
  fs::create_symlink(in, link);
  for (const std::string& out : {in, link}) {
    EXPECT_EQ(refused("law --in " + in + " --out " + out),
              "hysteron law: --out " + out + " is the input: give another file\n");
    EXPECT_EQ(file_content(in), "curvature [1/m]\n50\n");
  }
}

// More than --quick takes by itself.
TEST(Program, TakesTheTrianglesThatAreAskedForThoughItIsQuick) {
  const char* const lines[] = {"drape --triangles 1500",   "swing --triangles 600",
                               "crease --triangles 800",   "fold --triangles 700",
                               "crumple --triangles 2000", "cantilever --triangles 300",
                               "buckle --triangles 600"};
  for (const std::string line : lines) {
    const std::string requested = program(line + " --no-images --explain --device cpu").out;
    EXPECT_TRUE(says(requested, " triangles, ")) << line;
    EXPECT_EQ(program(line + " --quick --no-images --explain --device cpu").out, requested) << line;
  }
}

// Turns are counted from a hundredth of its length on.
TEST(Program, MeasuresASwingByTheStripThatItReads) {
  const Folder folder;
  const std::string file = folder.file("strip.obj");
  const ClothMesh strip = make_grid(0.09, 0.03, 9, 3, MeshFamily::unionjack, 1);
  write_obj(file, strip, strip.rest);
  const auto turns = [&](const std::string& flags) {
    const FinishedRun run(
        "swing --quiet --no-images --device cpu --threads 1 --seconds 1 --cloth.shape file --cloth.file " +
        file + flags);
    return run.metrics()["turns"].get<int>();
  };
  const int expected = turns("");
  EXPECT_GT(expected, 0);
  const std::string scene = folder.file("long.toml");
  std::ofstream(scene) << "[cloth]\nlength = 50\n";
  EXPECT_EQ(turns(" --scene " + scene), expected) << "the scene's own length is not the file's";
}

// Along every path, and says what bringing it to rest has moved.
TEST(Program, EndsADrapeAtRest) {
  for (const std::string release : {"lowered", "dropped", "relifted"}) {
    const FinishedRun run(
        "drape --triangles 200 --seconds 0.5 --device cpu --no-images --quiet --drape.release " + release +
        (release == "dropped" ? "" : " --drape.lowering 0.1"));
    const Json manifest = run.manifest();
    EXPECT_TRUE(manifest["metrics"]["settled"].get<bool>()) << release;
    EXPECT_TRUE(manifest["metrics"]["rest_shift_percent"].is_number()) << release;
    EXPECT_EQ(manifest["energy"]["kinetic"], 0) << release;
    EXPECT_GT(manifest["metrics"]["integrator_share_percent"], 0) << release;
    EXPECT_LT(manifest["metrics"]["integrator_share_percent"], 100) << release;
    EXPECT_LT(manifest["metrics"]["energy_remainder_relative"], 1e-9) << release;
  }
}

}  // namespace
}  // namespace hysteron::experiments
