// ErrorRunResult folding: the flexed specimen, what is read from it, and what many bends make of a material.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "experiments/fold/material.h"
#include "sim/base/csv.h"
#include "sim/bending/laws/law_parameters.h"
#include "tests/experiments/program.h"

namespace hysteron::experiments {
namespace {

constexpr double kSummed = 1e-9;    // relative, of sums over many steps
constexpr double kReleased = 1e-4;  // of M0: fatigue finds what weakening itself releases in two rounds

Scene small_scene() {
  Scene scene;
  scene.cloth.length = 0.06;
  scene.cloth.width = 0.03;
  scene.triangles = 200;
  scene.mesh = "unionjack";
  return scene;
}

double friction_moment(const Fabric& fabric) { return fabric.virgin_curve().friction_moment(); }

TEST(FoldSpecimen, IsClosedByItsStrokeAndNeverStretched) {
  FoldParams choice;
  choice.cycles = 3;
  choice.stroke = 0.35;
  const Fold fold = folded(small_scene(), choice, 40);
  EXPECT_NEAR(fold.free_length, 0.048, 1e-12);
  EXPECT_NEAR(fold.distance(0), 0.048, 1e-12);
  EXPECT_NEAR(fold.distance(1.5), 0.65 * 0.048, 1e-12);
  EXPECT_NEAR(fold.distance(3), 0.98 * 0.048, 1e-12);
  for (double t = 0; t <= 3; t += 0.01) EXPECT_LE(fold.distance(t), 0.048);
  EXPECT_EQ(fold.scene.phase_at(1.5), "cycle 2, folded");
  EXPECT_EQ(fold.scene.phase_at(3), "cycle 3, returned");
  EXPECT_EQ(fold.scene.phase_at(3.5), "let go");
}

TEST(FoldSpecimen, HasAWholeNumberOfStepsAndMomentsInHalfACycle) {
  Scene scene = small_scene();
  scene.step = 1.0 / 77;
  FoldParams choice;
  choice.period = 0.9;
  const Fold fold = folded(scene, choice, 33);
  EXPECT_NEAR(fold.half / fold.rate, 0.45, 1e-12);
  const double steps = 1 / (fold.rate * fold.scene.step);
  EXPECT_NEAR(steps, std::round(steps), 1e-9);
}

// Long cycles, and moments that the second after them is no multiple of.
TEST(FoldSpecimen, TakesAsLongAsItsPhases) {
  for (const double period : {0.9, 1.0, 3.0, 30.0, 1000.0}) {
    FoldParams choice;
    choice.cycles = 2;
    choice.period = period;
    const Scene scene = folded(small_scene(), choice, 33).scene;
    double phases = 0;
    for (const Phase& phase : scene.phase) {
      EXPECT_GT(phase.seconds, 0) << phase.name;
      phases += phase.seconds;
    }
    EXPECT_NEAR(phases, scene.seconds, scene.step / 2) << period;
  }
}

// Half of it is bent to K one way, half of it the other way.
TEST(FoldGauge, ReadsTheBendOfTheLimbsInAnyWarpDirection) {
  for (double warp_angle : {0.0, 90.0, 30.0}) {
    Scene scene = small_scene();
    scene.cloth.warp_angle = warp_angle;
    const Fold fold = folded(scene, {}, 40);
    const ClothMesh& mesh = fold.cloth.mesh;
    const double a = -warp_angle * std::numbers::pi / 180, k = 20;
    std::vector<double> tensor;
    double bent = 0;
    for (int f = 0; f < mesh.faces(); ++f) {
      const auto& c = mesh.face[f];
      const double x = (mesh.rest[c[0]] + mesh.rest[c[1]] + mesh.rest[c[2]]).x() / 3;
      const double here = x > 0.015 ? k : -k;
      if (here > 0) bent += k * mesh.face_area[f] / scene.cloth.width;
      for (double part :
           {std::cos(a) * std::cos(a), std::sin(a) * std::sin(a), std::sqrt(2.0) * std::sin(a) * std::cos(a)})
        tensor.push_back(here * part);
    }
    const FoldGauge gauge(fold);
    EXPECT_NEAR(gauge.crown(tensor), k, 1e-9) << warp_angle;
    // The column in which the bend changes its sense counts in part.
    EXPECT_NEAR(gauge.largest_turn(tensor), bent, 0.05 * bent) << warp_angle;
    // A fold that goes up is one that goes down, mirrored.
    std::vector<double> mirrored = tensor;
    for (double& part : mirrored) part = -part;
    EXPECT_DOUBLE_EQ(gauge.largest_turn(mirrored), gauge.largest_turn(tensor)) << warp_angle;
  }
}

TEST(Fold, GoesUpWhereGravityDoesWithTheSameAngleAndSag) {
  const auto reading = [](const std::string& gravity) {
    const FinishedRun run("fold --quick --no-images --quiet --fold.cycles 1 --triangles 60 --gravity \"" +
                          gravity + "\"");
    return run.metrics();
  };
  const auto down = reading("0 0 -9.81"), up = reading("0 0 9.81");
  EXPECT_LT(down["recovery_angle_deg"].get<double>(), 170);
  constexpr double kMirrored = 1e-3;  // which of two folds rounding chooses at the crown
  for (const char* metric : {"recovery_angle_deg", "sag_mm"})
    EXPECT_NEAR(up[metric].get<double>() / down[metric].get<double>(), 1, kMirrored) << metric;
}

FoldParams many(int cycles) {
  FoldParams choice;
  choice.cycles = cycles;
  choice.curvature = 150;
  return choice;
}

// A cycle between 0 and A, A/2 >= K0, is one of amplitude A/2 about A/2: it costs 4 M0 (A/2 - 2 K0/3).
TEST(BentRepeatedly, CostsTheClosedFormInEveryCycleWithoutFatigue) {
  const Scene scene = small_scene();
  const double m0 = friction_moment(scene.fabric), cost = 4 * m0 * (75 - 2 * scene.fabric.k0 / 3);
  const auto cycles = bend_repeatedly(scene, many(50));
  ASSERT_EQ(cycles.size(), 6u);  // 1, 2, 5, 10, 20, 50
  for (const BendingCycle& c : cycles) {
    if (c.cycle > 1) {
      EXPECT_NEAR(c.dissipated, cost, kSummed * cost);
    }
    EXPECT_NEAR(c.material.loop_width, 2 * m0, kSummed * m0);
    EXPECT_NEAR(c.material.friction, m0, kSummed * m0);
    EXPECT_NEAR(c.set, cycles[0].set, kSummed * c.set);
    EXPECT_EQ(c.material.permanent_set, 0);
  }
}

TEST(BentRepeatedly, LosesItsFrictionByTheEnergyItHasLostAndSetsWithinTheBound) {
  Scene scene = small_scene();
  const double m0 = friction_moment(scene.fabric), least = m0 / 10;
  scene.param = {{"fatigue.dc", "0.5"}, {"fatigue.m-inf", number_text(least)}};
  for (const char* law : {"prandtl", "wong", "bilinear"}) {
    scene.law = law;
    const auto cycles = bend_repeatedly(scene, many(1000));
    double set = 0;
    for (const BendingCycle& c : cycles) {
      const double left = least + (m0 - least) * std::exp(-c.total / 0.5);
      // The work of `wong`'s friction is not all lost, and what it gives back does not count.
      if (scene.law != "wong") {
        EXPECT_NEAR(c.material.friction, left, kReleased * m0) << law << " " << c.cycle;
      }
      EXPECT_GT(c.dissipated, 0);
      EXPECT_GE(c.material.permanent_set, set);
      set = c.material.permanent_set;
    }
    EXPECT_NEAR(cycles.back().material.loop_width, 2 * least, kReleased * m0) << law;
    EXPECT_GT(set, 0);
    EXPECT_LE(set, (m0 - least) / scene.fabric.b2);
  }
}

// Each cycle costs q M0/M0(0), so that dD = q exp(-D/Dc) dn: M0 falls as 1/(1 + n q/Dc).
TEST(BentRepeatedly, WeakensInInverseProportionToTheCycles) {
  Scene scene = small_scene();
  scene.param = {{"fatigue.dc", "5"}, {"fatigue.set", "0"}};
  const double m0 = friction_moment(scene.fabric), q = 4 * m0 * (75 - 2 * scene.fabric.k0 / 3);
  for (const BendingCycle& c : bend_repeatedly(scene, many(10000))) {
    const double expected = m0 / (1 + c.cycle * q / 5);
    EXPECT_NEAR(c.material.friction / expected, 1, 0.02) << c.cycle;
  }
}

// One command runs an elastic law, and a hysteretic one without and with fatigue.
TEST(Fold, RepeatsWithoutFatigueAndWeakensAndSetsWithIt) {
  const FinishedRun fold(
      "fold --law linear,prandtl --triangles 150 --fold.cycles 3 --fold.fatigue 1 --threads 1 --no-images "
      "--quiet");
  const auto& out = fold.out;
  EXPECT_EQ(read_table(out / "table.csv").rows.size(), 3u);
  const auto elastic = metrics_of(out / "linear"), sound = metrics_of(out / "prandtl"),
             tired = metrics_of(out / "prandtl-fatigue");
  for (const auto& run : {elastic, sound, tired}) {
    EXPECT_EQ(run["intersections"], 0);
    EXPECT_LT(run["energy_remainder_relative"], 1e-6);
    EXPECT_LT(run["max_stretch_percent"], 0.1);
  }
  EXPECT_NEAR(elastic["recovery_angle_deg"].get<double>(), 180, 1e-6);
  EXPECT_NEAR(elastic["2HB_N"].get<double>(), 0, 1e-12);
  EXPECT_LT(sound["recovery_angle_deg"], 165);
  EXPECT_GT(sound["recovery_angle_deg"], 90);
  EXPECT_LT(tired["M0_N"], 0.9 * sound["M0_N"].get<double>());
  EXPECT_LT(tired["2HB_N"], 0.9 * sound["2HB_N"].get<double>());
  EXPECT_EQ(sound["permanent_set_per_m"], 0);
  EXPECT_GT(tired["permanent_set_per_m"], 1);

  const Table repeats = read_csv(out / "prandtl" / "cycles.csv",
                                 {"cycle", "set_curvature [1/m]", "bending_friction [J]"}, {}, "test");
  ASSERT_EQ(repeats.rows.size(), 3u);
  for (const char* column : {"set_curvature [1/m]", "bending_friction [J]"}) {
    const std::vector<double> values = repeats.numbers(column);
    EXPECT_NEAR(values[2] / values[1], 1, 0.01) << column;
  }
  const Table wears =
      read_csv(out / "prandtl-fatigue" / "material.csv", {"M0 [N]", "permanent_set [1/m]"}, {}, "test");
  const std::vector<double> friction = wears.numbers("M0 [N]"), set = wears.numbers("permanent_set [1/m]");
  EXPECT_TRUE(std::is_sorted(friction.rbegin(), friction.rend()));
  EXPECT_TRUE(std::is_sorted(set.begin(), set.end()));
}

// Before any of the others has run.
TEST(Fold, OfSeveralLawsRefusesTheOneThatIsNone) {
  const Folder folder;
  const Outcome outcome =
      ended(2,
            "fold --quick --fold.law-alone --law linear,nonsense,prandtl --fold.fatigue 0 "
            "--no-images --quiet" +
                out_flag(folder.path() / "out"));
  EXPECT_TRUE(says(outcome.err, "nonsense: law = nonsense must be"));
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "out" / "table.csv"));
}

TEST(Fold, OfTheLawAloneWritesItsCyclesAndMetrics) {
  const Folder folder;
  const auto out = folder.path() / "run";
  EXPECT_EQ(run_into(out, "fold", {{"fold.law-alone", true}, {"fold.cycles", 1000}}), 0);
  const Table cycles = read_csv(out / "cycles.csv", {"cycle", "2HB [N]"}, {}, "test");
  EXPECT_EQ(cycles.numbers("cycle").back(), 1000);
  EXPECT_EQ(metrics_of(out)["2HB_N"].get<double>(), cycles.numbers("2HB [N]").back());
}

TEST(Fold, RefusesWhatCannotBeFolded) {
  const Folder folder;
  const std::vector<Flag> wrong = {{"fold.stroke", 1.2}, {"fold.stroke", 0},   {"fold.cycles", 0},
                                   {"fold.period", 0},   {"fold.fatigue", -1}, {"fold.curvature", 0},
                                   {"element", "hinge"}, {"param", "stops=4"}, {"fold.tension", "1"}};
  for (const Flag& flag : wrong) {
    // The law's own stops: the parameter says nothing of a fabric's.
    const std::string said = test::refusal([&] {
      run_into(folder.path() / "run", "fold", {{"fabric", "cotton-broad-k50"}, flag});
    });
    EXPECT_NE(said, "(accepted)") << flag.path << " = " << flag.text();
  }
}

}  // namespace
}  // namespace hysteron::experiments
