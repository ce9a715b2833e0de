// These tests read study files.
#include "experiments/sweep/study.h"

#include <cmath>
#include <set>

#include "experiments/sweep/tables.h"
#include "tests/experiments/folder.h"

namespace hysteron::experiments {
namespace {

Study parsed_study(const std::string& text) { return read_study(Folder().write("s.toml", text)); }

TEST(Study, RunsEveryCombinationTheLastAxisFirst) {
  const Study study = parsed_study(
      "experiment = \"swing\"\nseeds = 2\n[scene]\nfabric.damping = 1e-5\n"
      "[[axis]]\nkey = \"law\"\nvalues = [\"linear\", \"dahl\"]\n[[axis]]\nkey = \"fabric.k0\"\nvalues = "
      "[12.5, 40]\n");
  ASSERT_EQ(study.runs.size(), 2u * 2 * 2);
  EXPECT_EQ(study.runs[0].name, "law=linear,k0=12.5,seed=1");
  EXPECT_EQ(study.runs[1].name, "law=linear,k0=12.5,seed=2");
  EXPECT_EQ(study.runs[7].name, "law=dahl,k0=40,seed=2");
  EXPECT_FALSE(study.axes[0].numeric);
  EXPECT_TRUE(study.axes[1].numeric);
  EXPECT_EQ(study.axes[1].unit, "1/m");
  const CommandLine line = run_command_line(study, study.runs[7]);
  EXPECT_EQ(last_text(line.flags, "fabric.damping", ""), "1e-05");
  EXPECT_EQ(last_text(line.flags, "law", ""), "dahl");
  EXPECT_EQ(last_text(line.flags, "fabric.k0", ""), "40");
  EXPECT_EQ(last_text(line.flags, "seed", ""), "2");
}

TEST(Study, NamesShippedScenesAsEveryMachineDoes) {
  const Study study = read_study("drape-tension");
  EXPECT_EQ(study.axes[0].values,
            (std::vector<std::string>{"assets/studies/tension-1.toml", "assets/studies/tension-10.toml",
                                      "assets/studies/tension-100.toml"}));
}

TEST(Study, SpacesValuesByEqualDifferencesOrEqualRatios) {
  const Study study = parsed_study(
      "experiment = \"swing\"\n[[axis]]\nkey = \"step\"\nlog = [1e-3, 8e-3, 4]\n"
      "[[axis]]\nkey = \"triangles\"\nlinear = [100000, 200000, 3]\n");
  EXPECT_EQ(study.axes[0].values, (std::vector<std::string>{"0.001", "0.002", "0.004", "0.008"}));
  EXPECT_EQ(study.axes[1].values, (std::vector<std::string>{"100000", "150000", "200000"}))
      << "integers as their keys read them";
}

TEST(Study, NamesRunsApartWithCharactersThatShellsLeaveAlone) {
  const Study study = parsed_study(
      "experiment = \"swing\"\n[[axis]]\nkey = \"fabric.b1\"\nvalues = [1e-5, 2e-5]\n"
      "[[axis]]\nkey = \"gravity\"\nvalues = [\"0 0 -9.81\", \"0,0,-9.81\"]\n");
  std::set<std::string> names;
  for (const StudyRun& run : study.runs) {
    EXPECT_EQ(run.name.find_first_of(" '\"/\\$&;*?"), std::string::npos) << run.name;
    names.insert(run.name);
  }
  EXPECT_EQ(names.size(), 4u);
}

TEST(LatinHypercube, DrawsOnceFromEveryPartOfEveryAxis) {
  constexpr std::size_t kAxes = 3, kDraws = 40;
  const auto drawn = latin_hypercube(kAxes, kDraws, 1);
  ASSERT_EQ(drawn.size(), kAxes);
  for (const auto& axis : drawn) {
    std::set<int> parts;
    for (const double x : axis) parts.insert(static_cast<int>(std::floor(x * kDraws)));
    EXPECT_EQ(parts.size(), kDraws);
    EXPECT_EQ(*parts.begin(), 0);
    EXPECT_EQ(*parts.rbegin(), static_cast<int>(kDraws) - 1);
  }
  EXPECT_EQ(latin_hypercube(kAxes, kDraws, 1), drawn);
  EXPECT_NE(latin_hypercube(kAxes, kDraws, 2), drawn);
  EXPECT_NE(drawn[0], drawn[1]) << "axes are ordered independently";
}

TEST(Study, SamplesTwoAxesTogetherAndCrossesThemWithTheOthers) {
  const Study study = parsed_study(
      "experiment = \"swing\"\n[[axis]]\nkey = \"fabric.k0\"\nlog = [10, 1000]\n"
      "[[axis]]\nkey = \"law\"\nvalues = [\"dahl\", \"prandtl\"]\n"
      "[[axis]]\nkey = \"triangles\"\nlinear = [101, 110]\n[sample]\nmethod = \"latin\"\nn = 10\nseed = 3\n");
  ASSERT_EQ(study.runs.size(), 10u * 2);
  EXPECT_EQ(study.runs[0].name, "sample=01,law=dahl");
  EXPECT_EQ(study.runs[19].name, "sample=10,law=prandtl");
  EXPECT_EQ(study.runs[0].values[0], study.runs[1].values[0]);
  std::set<std::string> triangles;
  std::set<int> fifths;  // of a decade
  for (const std::string& value : study.axes[0].values)
    fifths.insert(static_cast<int>(std::floor(5 * std::log10(std::stod(value)))));
  for (const std::string& value : study.axes[2].values) triangles.insert(value);
  EXPECT_EQ(fifths.size(), 10u) << "ten draws over two decades";
  EXPECT_EQ(triangles.size(), 10u) << "ten draws of ten integers";
  EXPECT_EQ(*triangles.begin(), "101");
  EXPECT_EQ(*triangles.rbegin(), "110");
}

TEST(Study, RefusesInOneLineWithFileLineKeyAndRange) {
  const std::string swing = "experiment = \"swing\"\n", axis = swing + "[[axis]]\n";
  const std::pair<std::string, std::string> cases[] = {
      {"seeds = 2\n", "experiment must be a text (s.toml:1)"},
      {"experiment = \"swin\"\n", "experiment = swin must be drape | "},
      {swing, "a study needs an [[axis]] or seeds ("},
      {swing + "seed = 2\n", "unknown key seed; did you mean seeds? (s.toml:2)"},
      {swing + "seeds = 0\n", "seeds = 0 must be in [1, 1e+05] (s.toml:2)"},
      {swing + "seeds = 2\n[scene]\nfabric.b2 = -1\n", "fabric.b2 = -1 N m must be >= 0 (s.toml:4)"},
      {swing + "seeds = 2\n[scene]\nlaw = \"dal\"\n", "law = dal must be "},
      {swing + "seeds = 2\n[scene]\nout = \"x\"\n",
       "out is given to sweep (--out), not to its runs (s.toml:4)"},
      {swing + "seeds = 2\n[scene]\ntriangels = 10\n", "did you mean triangles?"},
      {"experiment = \"cantilever\"\nseeds = 2\n[scene]\nseconds = 9\n",
       "seconds cannot be set: cantilever sets seconds itself: the weight grows in ramp and goes in unload "
       "(s.toml:4)"},
      {axis + "key = \"fabric\"\nvalues = [\"woll-tropical\"]\n", "did you mean wool-tropical?"},
      {axis + "key = \"step\"\nvalues = [0.1, -0.1]\n", "step = -0.1 s must be in (0, 1] (s.toml:4)"},
      {axis + "key = \"step\"\nvalues = [0.1, 0.1]\n", "step = 0.1 stands twice among the values (s.toml:4)"},
      {axis + "key = \"step\"\n", "the axis step must have one of values, linear, log (s.toml:2)"},
      {axis + "key = \"step\"\nlog = [0, 1, 3]\n", "step: log = [0, 1] must have ends > 0 (s.toml:4)"},
      {axis + "key = \"step\"\nlinear = [0.1, 1, 1]\n",
       "step: linear: n = 1 must be an integer in [2, 100000] (s.toml:4)"},
      {axis + "key = \"triangles\"\nlinear = [100, 201, 3]\n", "triangles = 150.5 must be an integer"},
      {axis + "key = \"step\"\nlog = [0.1, 1]\n", "step has a range without n, which needs [sample]"},
      {axis + "key = \"step\"\nlog = [0.1, 1]\n[sample]\nmethod = \"sobol\"\nn = 3\n",
       "sample.method = sobol must be latin (s.toml:6)"},
      {swing + "[scene]\nstep = 0.1\n[[axis]]\nkey = \"step\"\nvalues = [0.1]\n", "step is set twice"},
  };
  const Folder folder;
  for (const auto& [text, message] : cases) {
    const std::string file = folder.write("s.toml", text);
    std::string said = test::refusal([&] { read_study(file); });
    if (const auto at = said.find(file); at != said.npos) said.replace(at, file.size(), "s.toml");
    EXPECT_TRUE(says(said, message)) << text;
  }
}

// Returns a run that found these metrics.
ChildRun found(const Metrics& metrics) {
  ChildRun column;
  column.manifest.emplace();
  column.manifest->metrics = metrics;
  return column;
}

TEST(Study, GivesARunASeedOnlyWhereItsMeshIsDrawn) {
  const Study study = parsed_study(
      "experiment = \"swing\"\nseeds = 2\n[[axis]]\nkey = \"mesh\"\nvalues = [\"random\", \"aligned\"]\n");
  ASSERT_EQ(study.runs.size(), 4u);
  int drawn = 0;
  for (const StudyRun& run : study.runs) {
    const CommandLine line = run_command_line(study, run);
    const bool has_seed = !last_text(line.flags, "seed", "").empty();
    EXPECT_EQ(has_seed, last_text(line.flags, "mesh", "") == "random") << run.name;
    drawn += has_seed;
  }
  EXPECT_EQ(drawn, 2);
}

TEST(Study, TellsTheMeanOfRepeatedDrawsWithItsStandardError) {
  constexpr double kRounding = 1e-12;
  const Study study = parsed_study(
      "experiment = \"swing\"\nseeds = 4\n[[axis]]\nkey = \"law\"\nvalues = [\"dahl\", \"prandtl\"]\n");
  std::vector<ChildRun> runs;
  for (const double x : {1, 2, 3, 4, 5, 5, 5, 5}) runs.push_back(found({{"x_m", x}}));
  runs.back().manifest.reset();  // one that is not complete
  const Table means = table_of_means(study, runs, {"x_m"});
  EXPECT_EQ(means.head, (std::vector<std::string>{"law", "draws", "x_m_mean", "x_m_stderr"}));
  ASSERT_EQ(means.rows.size(), 2u);
  EXPECT_EQ(means.rows[0][2], "2.5");
  EXPECT_NEAR(std::stod(means.rows[0][3]), std::sqrt(5.0 / 3 / 4), kRounding);  // variance 5/3 of four
  EXPECT_EQ(means.rows[1], (std::vector<std::string>{"prandtl", "4", "5", "0"}));
}

TEST(Study, WritesARowForEachRunWithNumbersTruthsAndTexts) {
  const Study study = parsed_study("experiment = \"swing\"\nseeds = 2\n");
  std::vector<ChildRun> runs = {found({{"x_m", 0.1}, {"settled", true}}), found({{"shape", "plateau"}})};
  runs[1].exit_code = 3;
  runs[1].stopped = "no convergence";
  const Table table = table_of_runs(study, runs);
  EXPECT_EQ(table.head, (std::vector<std::string>{"run", "seed", "x_m", "settled", "shape", "wall_s",
                                                  "state_hash", "exit_code", "stopped"}));
  EXPECT_EQ(table.rows[0], (std::vector<std::string>{"seed=1", "1", "0.1", "1", "", "0", "", "0", ""}));
  EXPECT_EQ(table.rows[1],
            (std::vector<std::string>{"seed=2", "2", "", "", "plateau", "0", "", "3", "no convergence"}));
}

}  // namespace
}  // namespace hysteron::experiments
