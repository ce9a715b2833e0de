// Studies as a script meets them, of runs that take a fiftieth of a second.
#include <algorithm>

#include "sim/base/atomic_file.h"
#include "tests/experiments/program.h"
#include "tests/experiments/sweep/timeless.h"

namespace hysteron::experiments {
namespace {

constexpr const char* kStudy =
    "experiment = \"kes\"\n[scene]\nno-images = true\nlaw = \"bilinear\"\n"
    "[[axis]]\nkey = \"fabric.k0\"\nvalues = [40, 80]\n[[axis]]\nkey = \"fabric.b2\"\nvalues = [1e-6, "
    "2e-6]\n";

class Sweep : public testing::Test {
 protected:
  Sweep() { write(kStudy); }
  void write(const std::string& text) { write_text(study_, text); }
  Outcome run(int exit_code, const std::string& options = "", const std::string& out = "out") const {
    return ended(exit_code, "sweep " + study_.string() + " --no-images --jobs 2" +
                                out_flag(folder_.path() / out) + " " + options);
  }
  Table table(const std::string& out = "out") const { return read_table(folder_.path() / out / "table.csv"); }
  Json manifest(const fs::path& in) const { return manifest_in(folder_.path() / in); }
  Folder folder_;
  fs::path study_ = folder_.path() / "s.toml";
};

TEST_F(Sweep, TabulatesWhatEveryRunHasFoundInItsOwnFolderAndRepeatsNothingThatIsFinished) {
  run(0);
  const Table whole = table();
  ASSERT_EQ(whole.rows.size(), 4u);
  const std::vector<std::string> first(whole.head.begin(), whole.head.begin() + 3);
  EXPECT_EQ(first, (std::vector<std::string>{"run", "fabric.k0", "fabric.b2"}));
  const auto column = std::find(whole.head.begin(), whole.head.end(), "2HB_N") - whole.head.begin();
  ASSERT_LT(column, std::ssize(whole.head));
  for (const auto& row : whole.rows) {
    const auto of_run = manifest(fs::path("out/runs") / row[0]);
    EXPECT_EQ(of_run["metrics"]["2HB_N"].get<double>(), std::stod(row[static_cast<std::size_t>(column)]));
    EXPECT_EQ(of_run["scene"]["fabric"]["k0"].get<double>(), std::stod(row[1]));
  }
  EXPECT_NE(whole.rows[0][static_cast<std::size_t>(column)], whole.rows[3][static_cast<std::size_t>(column)]);
  fs::remove_all(folder_.path() / "out/runs" / whole.rows[1][0]);
  fs::remove(folder_.path() / "out/table.csv");
  run(0, "--resume");
  EXPECT_EQ(manifest("out")["metrics"]["kept_count"], 3);
  expect_same(table(), whole);
  EXPECT_EQ(table().rows[0], whole.rows[0]) << "kept with its time";
  const auto files = manifest(fs::path("out/runs") / whole.rows[2][0])["files"];
  ASSERT_FALSE(files.empty());
  const fs::path lost = folder_.path() / "out/runs" / whole.rows[2][0] / files[0].get<std::string>();
  fs::remove(lost);
  run(0, "--resume");
  EXPECT_EQ(manifest("out")["metrics"]["kept_count"], 3) << "a run whose file is gone runs again";
  EXPECT_TRUE(fs::exists(lost));
}

TEST_F(Sweep, WarnsOfWhatItsRunsWarnOf) {
  write_text(folder_.path() / "scene.toml", "cloth.copies = 2\n");
  write(
      "experiment = \"swing\"\n[scene]\nscene = \"scene.toml\"\nno-images = true\ntriangles = 128\nseconds = "
      "0.02\n"
      "[[axis]]\nkey = \"law\"\nvalues = [\"linear\", \"dahl\"]\n");
  for (const char* how : {"--quiet", "--quiet --collect"}) {
    const Outcome outcome = run(0, how);
    const auto warnings = manifest("out")["warnings"];
    ASSERT_FALSE(warnings.empty());
    const std::string names = warnings[0].get<std::string>();
    for (const char* part : {"linear", "dahl", ": cloth.copies = 2 ("})
      EXPECT_TRUE(says(names, part)) << warnings;
    EXPECT_TRUE(says(outcome.err, "warning: "));
  }
}

TEST_F(Sweep, ListsRunsThatFailGoesOnAndExitsWithThree) {
  std::string text = kStudy;
  text.replace(text.find("2e-6"), 4, "1.0 ");  // a rigidity above b1
  write(text);
  const Outcome outcome = run(3);
  EXPECT_TRUE(says(outcome.err, "2 of 4 runs are not complete"));
  const Table found = table();
  for (std::size_t r = 0; r < 4; ++r) {
    const bool fails = r % 2 == 1;
    EXPECT_EQ(found.rows[r].back().empty(), !fails);
    EXPECT_EQ(found.rows[r][found.rows[r].size() - 2], fails ? "2" : "0");
  }
  EXPECT_TRUE(says(file_content(folder_.path() / "out/report.html"), "Not complete"));
}

// A rigidity above b1 is refused by each run that has it.
TEST_F(Sweep, IsNotCompleteWhileARunIsMissingAndSaysHowMany) {
  std::string text = kStudy;
  text.replace(text.find("2e-6"), 4, "1.0 ");
  write(text);
  for (const char* how : {"", "--collect"}) {
    const Outcome outcome = run(3, how);
    EXPECT_TRUE(says(outcome.out, "INCOMPLETE: 2 of 4 runs did not come to their end"));
    EXPECT_EQ(manifest("out")["complete"], false);
    EXPECT_EQ(manifest("out")["metrics"]["failed_count"], 2);
  }
  write(kStudy);
  EXPECT_FALSE(says(run(0, "--resume").out, "INCOMPLETE"));
  EXPECT_EQ(manifest("out")["complete"], true);
}

// Which metrics there are is known once a run has ended.
TEST_F(Sweep, RefusesMetricsThatNoRunHasFoundAndNamesTheNearest) {
  write(std::string("metrics = [\"B_N_m\", \"2HB_M\"]\n") + kStudy);
  const Outcome outcome = run(2, "--quiet");
  const std::string unknown = "found no 2HB_M (did you mean 2HB_N?)",
                    place = " (" + study_.string() + ":1)\n";
  EXPECT_EQ(outcome.err.find("warning: metrics: the first run has " + unknown + place), 0u) << outcome.err;
  EXPECT_TRUE(says(outcome.err, "metrics: no run has found 2HB_M (did you mean 2HB_N?); the runs are kept"));
  EXPECT_EQ(table().rows.size(), 4u);
  write(std::string("metrics = [\"B_N_m\", \"2HB_N\"]\n") + kStudy);
  run(0, "--collect");
  // Where all runs are there, nothing is touched and none runs.
  const auto page = [&] { return file_content(folder_.path() / "out" / "manifest.json"); };
  const std::string before = page();
  write(std::string("metrics = [\"B_N_m\", \"2HB_M\"]\n") + kStudy);
  EXPECT_FALSE(says(run(2, "--quiet").err, "warning: "));
  EXPECT_EQ(page(), before);
  // Four runs have found the same metrics, and each name is listed once.
  write(std::string("metrics = [\"nonsense\"]\n") + kStudy);
  const std::string all = run(2, "--quiet").err;
  ASSERT_TRUE(says(all, "2HB_N")) << all;
  EXPECT_EQ(all.find("2HB_N"), all.rfind("2HB_N")) << all;
}

TEST_F(Sweep, InPartsFindsTheTableOfTheWhole) {
  run(0, "", "whole");
  run(3, "--collect");  // nothing has run
  for (const char* part : {"--part 3/3", "--part 1/3", "--part 2/3"}) run(0, part);
  run(0, "--only k0=80,b2=2e-06");
  run(0, "--collect");
  expect_same(table(), table("whole"));
  run(2, "--part 5/4");
  run(2, "--only k0=81");
}

// The corner, let go, falls further than the middle of the side that is held.
TEST_F(Sweep, OfASceneShowsTheMetricsThatItAsksFor) {
  write_text(folder_.path() / "held.toml",
             "triangles = 64\nstep = 0.01\nseconds = 0.05\n[cloth]\nlength = 0.2\n"
             "[[pin]]\nlow = [-1, -1, -1]\nhigh = [0.01, 1, 1]\n"
             "[[metric]]\nname = \"corner\"\nkind = \"height\"\npoint = [0.2, 0.2, 0]\n");
  write(
      "experiment = \"run\"\nseeds = 2\n[scene]\nscene = \"held.toml\"\nmesh = \"random\"\n"
      "no-images = true\ndevice = \"cpu\"\n[[axis]]\nkey = \"fabric.b2\"\nvalues = [1e-6, 2e-6]\n");
  run(0);
  EXPECT_EQ(read_table(folder_.path() / "out/means.csv").head,
            (std::vector<std::string>{"fabric.b2", "draws", "corner_m_mean", "corner_m_stderr"}));
}

TEST_F(Sweep, WritesAWorkflowOfAJobForEachRun) {
  const fs::path flow = folder_.path() / "flow";
  run(0, "--snakemake " + flow.string());
  EXPECT_FALSE(fs::exists(folder_.path() / "out"));
  const auto config = read_json(flow / "config.json");
  EXPECT_EQ(config["jobs"].size(), 4u);
  EXPECT_EQ(config["jobs"]["3"]["words"][1], study_.string());
  EXPECT_EQ(config["jobs"]["3"]["words"].back(), "3/4");
  EXPECT_EQ(config["collects"].back(), "--collect");
  EXPECT_EQ(config["out"], (folder_.path() / "out").string());
  for (const char* file : {"Snakefile", "slurm/config.yaml"}) EXPECT_TRUE(fs::exists(flow / file)) << file;
}

// The manifest keeps the study, whose file may be gone: axes, what all runs share, and what pages show.
TEST_F(Sweep, IsRunAgainFromItsManifestAloneAndFromNoOther) {
  write(R"(experiment = "kes"
metrics = ["2HB_N"]
[scene]
no-images = true
law = "prandtl"
[scene.param]
stack = 8
[[axis]]
key = "fabric.k0"
log = [40, 80]
[[axis]]
key = "fabric.b2"
linear = [1e-6, 2e-6]
[[axis]]
key = "fabric.b1"
values = [5e-6, 6e-6]
[sample]
method = "latin"
n = 3
)");
  run(0);
  ASSERT_TRUE(fs::remove(study_));
  const std::string folder = (folder_.path() / "out").string(), again = (folder_.path() / "again").string();
  finished("rerun " + folder + " --no-images --out " + again);
  ASSERT_EQ(table().rows.size(), 6u);
  expect_same(table("again"), table());
  EXPECT_EQ(manifest("again")["scene"], manifest("out")["scene"]);
  Json other = manifest("out");
  study_ = folder_.path() / "other.json";
  for (const char* keys : {R"({"law": "prandtl"})", R"({"shared": [1], "axes": [{"key": 2}]})"}) {
    other["scene"] = json_in(keys, "keys");
    write(other.dump());
    const Outcome outcome = run(2, "", "other");
    EXPECT_TRUE(says(outcome.err, "is not the manifest of a sweep"));
  }
}

}  // namespace
}  // namespace hysteron::experiments
