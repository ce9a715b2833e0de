// A run's first and last lines have results with their errors, rest, places, time left.
#include "experiments/workbench/pages/closing_summary.h"

#include "experiments/workbench/compare/sweep_columns.h"
#include "tests/experiments/program.h"

namespace hysteron::experiments {
namespace {

Manifest manifest_with(const std::string& experiment, const Metrics& metrics) {
  Manifest manifest;
  manifest.experiment = experiment;
  manifest.metrics = metrics;
  manifest.complete = true;
  return manifest;
}

Manifest drape_manifest(const Metrics& metrics) { return manifest_with("drape", metrics); }

TEST(ResultWords, NameTheNumberItsUnitAndItsErrors) {
  const std::string words = result_text(drape_manifest({{"drape_coefficient_percent", 86.04},
                                                        {"drape_coefficient_percent_step_error", 0.8},
                                                        {"drape_coefficient_percent_mesh_error", 0.61},
                                                        {"node_count", 8},
                                                        {"settled", true}}));
  EXPECT_TRUE(
      says(words, "drape coefficient             86.0 % ± 0.8 step ± 0.6 mesh, draw error unknown\n"));
  EXPECT_TRUE(says(words, "folds                         8\n"));
  EXPECT_TRUE(says(words, "at rest\n"));
  EXPECT_FALSE(says(words, "NOT"));
}

TEST(ResultWords, OfAFitShowItsStandardError) {
  const Manifest manifest =
      manifest_with("swing", {{"decay_per_turn_percent", 2.0412}, {"decay_per_turn_percent_stderr", 0.0523}});
  EXPECT_TRUE(says(result_text(manifest), "mean loss in half a period of the run 2.04 % ± 0.05\n"));
}

TEST(ResultWords, SayAloudThatTheClothDidNotComeToRest) {
  const Metrics metrics = {{"settled", false}, {"fastest_m_per_s", 4.1e-3}, {"settling_limit_m_per_s", 2e-3}};
  EXPECT_TRUE(
      says(result_text(drape_manifest(metrics)), "NOT at rest: fastest vertex 4.1 mm/s, limit 2 mm/s\n"));
  // Nor is a number given as if it had: what was published is no result of the run.
  const std::string words = result_text(drape_manifest({{"drape_coefficient_percent", 86.04},
                                                        {"published_drape_coefficient_percent", 82.9},
                                                        {"settled", false}}));
  EXPECT_TRUE(says(words, "drape coefficient             86.0 % (not at rest)\n"));
  EXPECT_TRUE(says(words, "published coefficient         82.9 %\n"));
  EXPECT_EQ(not_at_rest_warning({{"settled", true}}), "");
  EXPECT_EQ(not_at_rest_warning({}), "") << "where no rest is asked for";
}

TEST(ResultWords, OfAComparisonHaveALineForEachColumn) {
  Manifest manifest = manifest_with("compare", {{"linear.drape_coefficient_percent", 72.2},
                                                {"linear.settled", false},
                                                {"prandtl.drape_coefficient_percent", 86.0}});
  manifest.keys = std::make_shared<const Json>(Json{{"compared", "drape"}});
  const std::string words = result_text(manifest);
  EXPECT_TRUE(
      says(words, "  linear                        drape coefficient 72.2 % (not at rest); NOT at rest\n"));
  EXPECT_TRUE(says(words, "  prandtl                       drape coefficient 86.0 %\n"));
}

TEST(ResultWords, NameWhatASceneAsksFor) {
  Manifest manifest = manifest_with("run", {{"gap_m", 0.0125}, {"gap_m_step_error", 2e-5}, {"fold_deg", 40}});
  EXPECT_EQ(result_text(manifest), "");
  manifest.requested_metrics = {"fold_deg", "gap_m"};
  EXPECT_TRUE(says(result_text(manifest),
                   "  fold                          40 °\n"
                   "  gap                           0.01250 m ± 2e-05 step, mesh and draw error unknown\n"));
}

TEST(ResultWords, OfARunThatWasCutShortSaySo) {
  Manifest manifest = drape_manifest({});
  manifest.complete = false;
  EXPECT_TRUE(says(result_text(manifest), "INCOMPLETE"));
}

TEST(LastWords, AreTheResultAndItsPlacesOnStdoutEvenIfQuiet) {
  const FinishedRun run("cantilever --quick --no-images --quiet --triangles 32");
  EXPECT_EQ(without_warnings(run.outcome.err), "");
  for (const std::string part : {"cantilever: cotton-broad, law prandtl\n", "tip drop over length",
                                 "bending length", " mm\n", "/out/report.html\n"})
    EXPECT_TRUE(says(run.outcome.out, part));
  EXPECT_FALSE(says(run.outcome.out, "sheet.png")) << "there is none";
}

TEST(LastWords, LeaveStdoutToTheManifestWithJson) {
  const FinishedRun run("swing --quick --no-images --seconds 0.05 --triangles 60 --json");
  EXPECT_EQ(json_in(run.outcome.out, "stdout").at("experiment"), "swing");
  EXPECT_TRUE(says(run.outcome.err, "cotton-broad, law prandtl, "));
}

TEST(TimeLeft, IsTheTimeSoFarTimesWhatIsLeftOverWhatIsDone) {
  EXPECT_EQ(time_left(10, 40, 4, false), "  12 s left");
  EXPECT_EQ(time_left(10, 40, 4, true), "  at most 12 s left");
  EXPECT_EQ(time_left(100, 200, 180, false), "  3 min left");
  EXPECT_EQ(time_left(100, 200, 3900, false), "  1 h 5 min left");
  EXPECT_EQ(time_left(4, 40, 4, false), "") << "too early to tell";
  EXPECT_EQ(time_left(40, 40, 4, false), "");
}

TEST(ColumnProgress, IsTheLastWholeMomentOfTheRunsTable) {
  const Folder folder;
  EXPECT_EQ(progress_in(folder.path()), "");
  folder.write("manifest.json", R"({"hysteron": {}, "scene": {"seconds": 4}})");
  folder.write("metrics.csv.part", "time [s],x\n0,1\n1.2,3\n2.");
  EXPECT_EQ(progress_in(folder.path()), "1.20/4 s");
}

TEST(ReportOfMotion, SaysAtItsTopThatTheClothDidNotComeToRest) {
  const FinishedRun run("drape --quick --no-images --quiet --triangles 100 --seconds 0.1");
  EXPECT_TRUE(says(run.outcome.out, "NOT at rest: fastest vertex "));
  EXPECT_TRUE(says(run.outcome.err, "warning: no state of rest was found: "));
  const std::string page = file_content(run.out / "report.html");
  EXPECT_TRUE(says(page, "NOT at rest: fastest vertex "));
  EXPECT_TRUE(says(page, "% (not at rest)"));
}

}  // namespace
}  // namespace hysteron::experiments
