// Headline numbers with their errors: what is repeated, what is made of it, how it is written.
#include <cmath>

#include "experiments/workbench/compare/errors.h"
#include "experiments/workbench/pages/error_notes.h"
#include "experiments/workbench/pages/metrics.h"
#include "experiments/workbench/pages/text_table.h"
#include "sim/base/csv.h"
#include "tests/experiments/program.h"

namespace hysteron::experiments {
namespace {

Scene scene_on(const std::string& mesh, ClothOutline shape) {
  Scene scene = default_scene();
  scene.mesh = mesh;
  scene.cloth.shape = shape;
  scene.triangles = 1000;
  scene.step = 0.01;
  scene.seed = 7;
  return scene;
}

// "mesh: triangles=4000; step: step=0.005; ...".
std::string words(const std::vector<ErrorRun>& error_runs) {
  std::string text;
  for (const ErrorRun& error_run : error_runs) {
    text += (text.empty() ? "" : "; ") + error_run.name + ":";
    for (const Flag& flag : error_run.changes) text += " " + flag.path + "=" + flag.text();
  }
  return text;
}

TEST(Repeats, OfARandomMeshAreFinerShorterAndOfOtherSeeds) {
  EXPECT_EQ(words(planned_error_runs("swing", scene_on("random", ClothOutline::strip), "", 3)),
            "mesh: triangles=4000; step: step=0.005; draw-1: mesh=random seed=8; draw-2: mesh=random seed=9; "
            "draw-3: mesh=random seed=10");
}

TEST(Repeats, OfAStructuredMeshAreOfOtherFamiliesFirst) {
  EXPECT_EQ(words(planned_error_runs("cantilever", scene_on("unionjack", ClothOutline::strip), "", 2)),
            "mesh: triangles=4000; step: step=0.005; draw-1: mesh=equilateral; draw-2: mesh=random seed=8");
}

TEST(Repeats, OfASpecimenThatCutsItsOwnMeshHaveOtherNumbersOfTriangles) {
  EXPECT_EQ(words(planned_error_runs("crease", scene_on("random", ClothOutline::strip), "", 2)),
            "mesh: triangles=4000; step: step=0.005; draw-1: triangles=1500; draw-2: triangles=666");
}

// The angles of a standard, at once, after 15 s and in the end; one without the second has no error of it.
TEST(Errors, OfACreaseInTimeAreThoseOfEachOfItsAngles) {
  const Metrics run = {
      {"release_angle_deg", 68.0}, {"recovery_angle_15_s_deg", 73.0}, {"recovery_angle_deg", 77.0}};
  const Metrics finer = {
      {"release_angle_deg", 67.0}, {"recovery_angle_15_s_deg", 75.0}, {"recovery_angle_deg", 80.0}};
  const Errors errors = estimated_errors("crease", run, {{{"step", {}}, finer}, {{"mesh", {}}, run}});
  EXPECT_EQ(errors.metrics["release_angle_deg_step_error"].number(), 1);
  EXPECT_EQ(errors.metrics["recovery_angle_15_s_deg_step_error"].number(), 2);
  EXPECT_EQ(errors.metrics["recovery_angle_deg_step_error"].number(), 3);
  EXPECT_EQ(errors.metrics["recovery_angle_15_s_deg_mesh_error"].number(), 0);
  const Errors at_once = estimated_errors("crease", {{"recovery_angle_deg", 77.0}}, {{{"step", {}}, finer}});
  EXPECT_FALSE(at_once.metrics.contains("recovery_angle_15_s_deg_step_error"));
}

TEST(Repeats, OfADrapeGoAlongTheOtherPathToo) {
  const Scene scene = scene_on("random", ClothOutline::disc);
  EXPECT_EQ(words({planned_error_runs("drape", scene, "lowered", 1).back()}), "path: drape.release=dropped");
  EXPECT_EQ(words({planned_error_runs("drape", scene, "dropped", 1).back()}), "path: drape.release=lowered");
}

TEST(Repeats, AtHalfTheStepKeepAToleranceToMatch) {
  Scene scene = scene_on("random", ClothOutline::disc);
  scene.tolerance = 8e-5;
  scene.integrator = Integrator::tr_bdf2;
  EXPECT_EQ(words({planned_error_runs("drape", scene, "lowered", 0)[1]}), "step: step=0.005 tolerance=1e-05");
  scene.integrator = Integrator::implicit;
  EXPECT_EQ(words({planned_error_runs("drape", scene, "lowered", 0)[1]}), "step: step=0.005 tolerance=2e-05");
}

TEST(Repeats, OfAClothFromAFileSubdivideItAndHaveNoOtherDraws) {
  const std::vector<ErrorRun> error_runs =
      planned_error_runs("crumple", scene_on("sheet.obj", ClothOutline::square), "", 2);
  EXPECT_EQ(words(error_runs), "mesh: cloth.subdivisions=1; step: step=0.005");
  const Metrics metrics = {{"curvature_rms_per_m", 5.0}};
  const Errors errors = estimated_errors(
      "crumple", metrics,
      {{error_runs[0], {{"curvature_rms_per_m", 7.0}}}, {error_runs[1], {{"curvature_rms_per_m", 6.0}}}});
  EXPECT_EQ(errors.metrics["curvature_rms_per_m_mesh_error"].number(), 2);
  EXPECT_EQ(errors.metrics["curvature_rms_per_m_step_error"].number(), 1);
  EXPECT_FALSE(errors.metrics["curvature_rms_per_m_draw_error"].is_known());
  ASSERT_EQ(errors.missing.size(), 1);
  EXPECT_TRUE(says(errors.missing[0], "from a file"));
}

ErrorRunResult bent(const std::string& name, double length) {
  return {{name, {{"seed", 2}}}, {{"bending_length_m", length}}};
}

TEST(Repeats, OfEquilibriaHaveNoStep) {
  EXPECT_EQ(words(planned_error_runs("buckle", scene_on("random", ClothOutline::strip), "", 1)),
            "mesh: triangles=4000; draw-1: mesh=random seed=8");
  const Errors errors =
      estimated_errors("buckle", {{"critical_gamma", 8.0}}, {{{"mesh", {}}, {{"critical_gamma", 7.0}}}});
  EXPECT_EQ(errors.metrics["critical_gamma_mesh_error"].number(), 1);
  EXPECT_FALSE(errors.metrics["critical_gamma_step_error"].is_known());
  EXPECT_EQ(errors.missing,
            std::vector<std::string>{"step: buckle finds equilibria at loads that --step does not set"});
}

TEST(Errors, AreDifferencesToTheRunAndTheDeviationOverDraws) {
  const Metrics metrics = {{"bending_length_m", 8.0}};
  const Errors errors = estimated_errors(
      "cantilever", metrics,
      {bent("mesh", 7.5), bent("step", 8.25), bent("draw-1", 7), bent("draw-2", 9), bent("path", 7)});
  EXPECT_EQ(errors.metrics["bending_length_m_step_error"].number(), 0.25);
  EXPECT_EQ(errors.metrics["bending_length_m_mesh_error"].number(), 0.5);
  EXPECT_EQ(errors.metrics["bending_length_m_draw_error"].number(), 1);  // of 7, 8, 9
  EXPECT_EQ(errors.metrics["bending_length_m_path_difference"].number(), -1);
  EXPECT_FALSE(errors.metrics.contains("bending_length_m_mean"));
  EXPECT_TRUE(errors.missing.empty());
}

TEST(Errors, OfThreeDrawsHaveAMeanAndItsStandardError) {
  const Metrics metrics = {{"bending_length_m", 6.0}};
  const Errors errors = estimated_errors(
      "cantilever", metrics,
      {bent("mesh", 7.5), bent("step", 8.25), bent("draw-1", 6), bent("draw-2", 8), bent("draw-3", 8)});
  EXPECT_EQ(errors.metrics["bending_length_m_mean"].number(), 7);
  EXPECT_NEAR(errors.metrics["bending_length_m_draw_error"].number(), std::sqrt(4.0 / 3), 1e-15);
  EXPECT_NEAR(errors.metrics["bending_length_m_mean_stderr"].number(), std::sqrt(1.0 / 3), 1e-15);
}

TEST(Errors, ThatAreNotKnownAreNullAndSaidToBe) {
  ErrorRunResult stopped = bent("mesh", 7.5), same = bent("step", 8), without = bent("draw-1", 7);
  stopped.stopped = "no convergence";
  same.unchanged = true;
  without.metrics = {};
  const Errors errors = estimated_errors("cantilever", {{"bending_length_m", 8.0}}, {stopped, same, without});
  for (const char* ending : {kStepError, kMeshError, kDrawError})
    EXPECT_FALSE(errors.metrics[std::string("bending_length_m") + ending].is_known()) << ending;
  ASSERT_EQ(errors.missing.size(), 3);
  EXPECT_EQ(errors.missing[0], "mesh (--seed=2) is not complete: no convergence");
  EXPECT_TRUE(says(errors.missing[1], "changes no bit"));
  EXPECT_EQ(errors.missing[2], "draw-1 has no bending_length_m");
}

const Metrics kDrape = {{"drape_coefficient_percent", 86.0213},
                        {"node_count", 8},
                        {"drape_coefficient_percent_step_error", 0.1042},
                        {"drape_coefficient_percent_mesh_error", 0.612},
                        {"drape_coefficient_percent_draw_error", 0.83},
                        {"node_count_step_error", 0},
                        {"node_count_mesh_error", nullptr},
                        {"node_count_draw_error", 0.577},
                        {"max_stretch_percent", 0.25}};

TEST(HeadlineWords, EndWhereTheErrorsDo) {
  EXPECT_EQ(with_errors(kDrape, "drape_coefficient_percent"),
            "drape coefficient 86.0 % ± 0.10 step ± 0.6 mesh ± 0.8 draw");
  EXPECT_EQ(with_errors(kDrape, "node_count"), "node count 8 ± 0 step ± 0.6 draw, mesh error unknown");
  EXPECT_EQ(with_errors(kDrape, "max_stretch_percent"), "max stretch 0.25 %");
}

TEST(HeadlineWords, WriteSmallNumbersInPowersOfTen) {
  const Metrics swing = {{"bending_friction_J", 1.2345e-5},
                         {"bending_friction_J_step_error", 3.4e-8},
                         {"bending_friction_J_mesh_error", 1.2e-7},
                         {"bending_friction_J_draw_error", 2e-7},
                         {"bending_friction_J_mean", 1.25e-5},
                         {"bending_friction_J_mean_stderr", 1e-7},
                         {"bending_friction_J_path_difference", -4e-7}};
  EXPECT_EQ(
      with_errors(swing, "bending_friction_J"),
      "bending friction 1.23e-05 J ± 3e-08 step ± 1.2e-07 mesh ± 2e-07 draw, other path -4e-07, mean of "
      "draws 1.250e-05 ± 1.0e-07");
}

TEST(MetricCards, ShowErrorsBesideTheirHeadline) {
  const std::string html = metric_cards(kDrape);
  EXPECT_TRUE(says(html, "<b>86.0 <small>% ± 0.10 step ± 0.6 mesh ± 0.8 draw</small></b>"));
  EXPECT_FALSE(says(html, "step error"));
  EXPECT_TRUE(says(html, "<b>0.25 <small>%</small></b>"));
}

TEST(MetricTable, ShowsErrorsInTheHeadlinesCell) {
  Metrics all;
  for (const auto& [key, value] : kDrape) all.set("prandtl." + key, value);
  all.set("linear.drape_coefficient_percent", 72.0);
  const std::string html = metric_table(all);
  EXPECT_TRUE(says(html, ">86.0 ± 0.10 step ± 0.6 mesh ± 0.8 draw<"));
  EXPECT_TRUE(says(html, ">72<"));
  EXPECT_FALSE(says(html, "step error"));
}

const std::string kSmall = " --triangles 60 --seconds 0.05 --fps 30 --device cpu --no-images --quiet";

// Returns the friction loss of a run with these flags.
double friction_with(const std::string& flags) {
  return FinishedRun("swing --no-images --quiet --device cpu --seconds 0.05 --fps 30 " + flags)
      .metrics()["bending_friction_J"];
}

TEST(SwingWithErrors, FindsWhatSeparateRunsFind) {
  const Folder folder;
  const InFolder here(folder.path());
  finished("swing --errors --out run" + kSmall);
  const Json manifest = manifest_in("run"), metrics = manifest["metrics"];
  const double run = metrics["bending_friction_J"].get<double>();
  ASSERT_GT(run, 0);
  EXPECT_EQ(metrics["bending_friction_J_step_error"],
            std::abs(friction_with("--triangles 60 --step 0.0020833333333333333") - run));
  EXPECT_EQ(metrics["bending_friction_J_mesh_error"], std::abs(friction_with("--triangles 240") - run));
  const double one = friction_with("--triangles 60 --mesh equilateral"),
               two = friction_with("--triangles 60 --mesh random --seed 2"), mean = (run + one + two) / 3;
  EXPECT_NE(one, run);
  EXPECT_NE(two, run);
  const double squares = std::pow(run - mean, 2) + std::pow(one - mean, 2) + std::pow(two - mean, 2);
  EXPECT_NEAR(metrics["bending_friction_J_draw_error"].get<double>() / std::sqrt(squares / 2), 1, 1e-9);
  EXPECT_TRUE(manifest["complete"].get<bool>());
  EXPECT_FALSE(manifest.contains("errors_missing"));
  EXPECT_GT(manifest["wall_seconds"]["errors"].get<double>(), 0);
  EXPECT_GT(manifest["wall_seconds"]["setup"].get<double>(), 0);

  const Table table = read_table("run/errors.csv");
  ASSERT_EQ(table.rows.size(), 4);
  EXPECT_EQ(table.head.front(), "repeat");
  EXPECT_EQ(table.rows[0][1], "triangles=240");
  EXPECT_TRUE(says(file_content("run/report.html"), " step ± "));
}

TEST(SwingWithErrors, PassesFlagsOnButThoseThatItChanges) {
  const FinishedRun run(
      "swing --errors --errors.draws 1 --fabric.b2 4e-6 --mesh random --seed 5 --law prandtl "
      "--param stack=8 --json" +
      kSmall);
  for (const char* name : {"mesh", "step", "draw-1"}) {
    const Json scene = manifest_in(run.out / "errors" / name)["scene"];
    EXPECT_EQ(scene["fabric"]["b2"], 4e-6) << name;
    EXPECT_EQ(scene["param"]["stack"], "8") << name;
    EXPECT_EQ(scene["seed"], std::string(name) == "draw-1" ? 6 : 5) << name;
    EXPECT_EQ(scene["triangles"], std::string(name) == "mesh" ? 240 : 60) << name;
    EXPECT_EQ(scene["step"], std::string(name) == "step" ? 1.0 / 480 : 1.0 / 240) << name;
  }
}

// The second mesh's folder cannot be made.
TEST(SwingWithErrors, SaysWhichRepeatFailed) {
  const Folder folder;
  const fs::path run = folder.path() / "run";
  fs::create_directories(run / "errors");
  folder.write("run/errors/mesh", "a file");
  const Outcome outcome = finished(
      "swing --errors --triangles 60 --seconds 0.05 --fps 30 --device cpu --no-images" + out_flag(run));
  const Json manifest = manifest_in(run);
  EXPECT_TRUE(manifest["metrics"]["bending_friction_J_mesh_error"].is_null());
  EXPECT_TRUE(manifest["metrics"]["bending_friction_J_step_error"].is_number());
  ASSERT_EQ(manifest["errors_missing"].size(), 1);
  const std::string missing = manifest["errors_missing"][0].get<std::string>();
  EXPECT_EQ(manifest["warnings"].back(), "errors: " + missing);
  EXPECT_TRUE(says(outcome.err, "warning: errors: " + missing));
  EXPECT_TRUE(missing.starts_with("mesh (--triangles=240) is not"));
  const Table table = read_table(run / "errors.csv");
  const auto complete = std::find(table.head.begin(), table.head.end(), "complete") - table.head.begin();
  EXPECT_EQ(table.rows[0][complete], "0");
  EXPECT_EQ(table.rows[1][complete], "1");
  EXPECT_TRUE(says(file_content(run / "report.html"), "Errors that are not known: mesh"));
  EXPECT_TRUE(says(outcome.err, "mesh error unknown"));
}

// Otherwise every repeat would repeat itself.
TEST(SwingWithErrors, AsksForNoErrorsOfRepeatsWhereASceneFileDoes) {
  const Folder folder;
  const fs::path run = folder.path() / "run";
  const std::string scene = "errors = true\nout = \"" + run.string() + "\"\ntriangles = 60\nseconds = 0.05\n";
  finished("swing --no-images --quiet --device cpu --scene " + folder.write("scene.toml", scene));
  EXPECT_TRUE(metrics_of(run).contains("bending_friction_J_draw_error"));
  EXPECT_TRUE(fs::exists(run / "errors/draw-2/manifest.json"));
  EXPECT_FALSE(fs::exists(run / "errors/draw-2/errors"));
}

TEST(Compare, GivesEachColumnItsErrors) {
  const FinishedRun run("compare swing --laws linear,prandtl --errors --errors.draws 1" + kSmall);
  const Json metrics = run.manifest()["metrics"];
  EXPECT_EQ(metrics["linear.bending_friction_J_step_error"], 0);
  EXPECT_GT(metrics["prandtl.bending_friction_J_step_error"].get<double>(), 0);
  EXPECT_TRUE(says(file_content(run.out / "report.html"), " step ± "));
}

TEST(RequestForErrors, IsRefusedWhereThereIsNone) {
  const Folder folder;
  const std::string out = " --quiet --no-images" + out_flag(folder.path() / "out");
  EXPECT_TRUE(says(refused("bench --quick --errors" + out), "bench has no headline"));
  EXPECT_TRUE(says(refused("fold --fold.law-alone --errors" + out), "fold.law-alone"));
  EXPECT_FALSE(fs::exists(folder.path() / "out/manifest.json"));
}

}  // namespace
}  // namespace hysteron::experiments
