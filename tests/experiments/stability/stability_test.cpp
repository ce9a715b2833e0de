#include "experiments/stability/stability.h"
#include "experiments/stability/ripple.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "experiments/workbench/app/key_conditions.h"
#include "sim/scene/scene_reader.h"
#include "tests/experiments/folder.h"

namespace hysteron::experiments {
namespace {

const CellEffort kShort{0.05, 200};

// Returns a small square that hangs by an edge.
Attempt hanging() {
  Attempt attempt{default_scene()};
  attempt.scene.cloth.length = 0.1;
  attempt.scene.triangles = 32;
  attempt.scene.device = DeviceChoice::cpu;
  attempt.scene.threads = 1;
  Pin edge;
  edge.low = {0, -1, -1};
  edge.high = {1e-6, 1, 1};
  attempt.scene.pin = {edge};
  return attempt;
}

TEST(Attempt, OfAQuietSceneEndsWithinTheEnergyThatWasPutIn) {
  const Finding f = probe_stability(hanging(), kShort);
  EXPECT_EQ(f.outcome, Outcome::ended) << f.message;
  EXPECT_GT(f.energy_growth, 0);
  constexpr double kNothingCreated = 1 + 1e-6;  // the integrator's share in a swing of a few mm
  EXPECT_LE(f.energy_growth, kNothingCreated);
  EXPECT_GT(f.largest_stretch, 0) << "it hangs";
  EXPECT_NEAR(f.seconds_simulated, kShort.seconds, hanging().scene.step);
  EXPECT_EQ(f.retried_steps, 0);
}

TEST(Attempt, ThatTheProgramRefusesKeepsItsReason) {
  Attempt attempt = hanging();
  attempt.scene.fabric.k0 = 0;
  const Finding f = probe_stability(attempt, kShort);
  EXPECT_EQ(f.outcome, Outcome::refused);
  EXPECT_TRUE(says(f.message, "fabric.k0 = 0"));
  EXPECT_EQ(f.steps, 0);
}

// The bound on the explicit step is that of the cloth at rest; stretched to many times its length the
// membrane is stiffer, as the square of the stretch.
TEST(Attempt, ThatOverstretchesAnExplicitMembraneDiverges) {
  Attempt attempt = hanging();
  attempt.scene.integrator = Integrator::explicit_euler;
  attempt.scene.fabric.damping = 0;
  attempt.scene.fabric.warp = attempt.scene.fabric.weft = 1;
  attempt.scene.fabric.shear = 0.1;
  attempt.scene.gravity *= 1000;
  const Finding f = probe_stability(attempt, {0.5, 5000});
  EXPECT_EQ(f.outcome, Outcome::diverged);
  EXPECT_FALSE(f.message.empty());
  EXPECT_FALSE(f.energy_growth <= kLargestGrowth);
}

TEST(Attempt, IsCutShortWhenItsWorkIsDone) {
  Attempt attempt = hanging();
  attempt.scene.integrator = Integrator::semi_implicit;
  attempt.scene.step = 1e-3;
  attempt.scene.substeps = 10;
  const Finding f = probe_stability(attempt, {1, 200});
  EXPECT_EQ(f.steps, 20);
  EXPECT_EQ(f.requested_seconds, 1);
  EXPECT_NEAR(f.seconds_simulated, 20 * attempt.scene.step, 1e-12);
}

TEST(Sweeps, CoverWhatTheProgramPromises) {
  const SweepParams all;
  const std::vector<Sweep> sweeps = named_sweeps({"all"}, all);
  const std::vector<SweepCell> cells = untried_cells(sweeps, all);
  EXPECT_GE(cells.size(), 600u);
  double softest = 1, stiffest = 0, shortest = 1, longest = 0;
  for (const SweepCell& cell : cells) {
    const Scene& s = cell.attempt.scene;
    if (cell.sweep != "bending-step") continue;
    softest = std::min(softest, s.fabric.b2), stiffest = std::max(stiffest, s.fabric.b2);
    shortest = std::min(shortest, s.step), longest = std::max(longest, s.step);
    EXPECT_GE(s.fabric.b1, s.fabric.b2);
  }
  EXPECT_DOUBLE_EQ(softest, 1e-8);
  EXPECT_DOUBLE_EQ(stiffest, 1e-1);
  EXPECT_DOUBLE_EQ(shortest, 1e-5);
  EXPECT_DOUBLE_EQ(longest, 1.0 / 24);
}

TEST(Sweeps, HaveMeshesOfTheQualityThatTheyName) {
  const Sweep sweep = named_sweeps({"mesh"}, {}).front();
  const auto flattest = [](const ClothMesh& mesh) {  // smallest height over longest edge
    double least = 1;
    for (int f = 0; f < mesh.faces(); ++f) {
      double longest = 0;
      for (int i = 0; i < 3; ++i)
        longest =
            std::max(longest, (mesh.rest[mesh.face[f][i]] - mesh.rest[mesh.face[f][(i + 1) % 3]]).norm());
      least = std::min(least, 2 * mesh.face_area[f] / (longest * longest));
    }
    return least;
  };
  for (std::size_t row = 0; row < sweep.y.ticks.size(); ++row) {
    const ClothMesh mesh = *sweep.at(0, 0, static_cast<int>(row)).mesh;
    const auto [small, large] = std::minmax_element(mesh.face_area.begin(), mesh.face_area.end());
    const std::string& name = sweep.y.ticks[row];
    if (name == "aspect 1000") {
      EXPECT_NEAR(flattest(mesh), 1e-3, 1e-5);
    }
    if (name == "slivers 1:1000") {
      EXPECT_NEAR(flattest(mesh), 1e-3 / std::sqrt(2), 5e-4);
    }
    if (name == "sizes 1:100") {
      EXPECT_NEAR(std::sqrt(*large / *small), 100, 1);
    }
  }
}

TEST(Sweeps, OfTheChapterHaveItsWholeMethodAndNoOtherIntegrator) {
  SweepParams quick;
  quick.quick = true;
  const std::vector<SweepCell> cells = untried_cells(named_sweeps({"chapter-method"}, quick), quick);
  EXPECT_EQ(cells.size(), 2u * 2 * 2) << "two forces, two rigidities, two steps";
  int printed = 0;
  for (const SweepCell& cell : cells) {
    const Scene& s = cell.attempt.scene;
    EXPECT_EQ(s.law, "wong");
    EXPECT_EQ(s.element, BendingElement::hinge);
    EXPECT_EQ(s.integrator, Integrator::semi_implicit);
    EXPECT_EQ(s.implicit_every, ImplicitEvery::step);
    printed += s.force == ForceConvention::chapter;
  }
  EXPECT_EQ(printed, 4);
  SweepParams other = quick;
  other.integrators = {"bdf2"};
  for (const Sweep& sweep : named_sweeps({"all"}, other)) EXPECT_NE(sweep.name, "chapter-method");
  EXPECT_TRUE(says(test::refusal([&] { named_sweeps({"chapter-method"}, other); }), "semi-implicit"));
}

// The energy balance of one mode, 18.5 % a period with `prandtl` and 21.1 % with `wong` at k0, leaves out
// that friction changes the mode's shape.  The membrane, solved implicitly, takes 0.2 % in a period of 80
// steps.
TEST(Ripple, AtTheHighestFrequencyDecaysByFrictionAsItsLoopsSayAndHardlyWithout) {
  constexpr double kOfTheMode = 0.02, kMembrane = 0.005;
  for (const char* law : {"prandtl", "wong"}) {
    const Ripple ripple = measure_ripple({Integrator::semi_implicit, law, 1, 20});
    ASSERT_EQ(ripple.failed, "") << law;
    EXPECT_NEAR(ripple.decay / ripple.closed_form, 1, kOfTheMode) << law;
    EXPECT_LT(std::abs(ripple.change()), kOfTheMode * ripple.decay) << law;
  }
  const Ripple without = measure_ripple({Integrator::semi_implicit, "linear", 1, 80});
  EXPECT_LT(std::abs(without.decay), kMembrane);
}

// A period of n steps of backward Euler takes the part 1 - (1 + (2 pi/n)^2)^(-n/2).
TEST(Ripple, WithoutFrictionDecaysAsBackwardEulerDampsIt) {
  constexpr double kSteps = 40, kPi = 3.14159265358979323846;
  const Ripple ripple = measure_ripple({Integrator::implicit, "linear", 1, kSteps});
  const double w = 2 * kPi / kSteps;
  // The numerical solution's period is longer than the beam's by w^2/3, and turning points stand between
  // steps.
  constexpr double kTurns = 0.03;
  EXPECT_NEAR(ripple.decay / (1 - std::pow(1 + w * w, -kSteps / 2)), 1, kTurns);
}

TEST(Ripple, VerdictIsOnlyGivenAboveItsControl) {
  const auto made_up = [](const char* law, double steps, double decay, double control) {
    Ripple ripple{{Integrator::implicit, law, 1, steps}};
    ripple.decay = decay;
    ripple.control = control;
    return ripple;
  };
  const Ripple coarse = made_up("linear", 20, 0.9, 0.1);
  const RippleVerdict shown =
      ripple_verdict({coarse, made_up("linear", 80, 0.02, 0.01), made_up("prandtl", 80, 0.2, 0.17)});
  EXPECT_NEAR(shown.excess, 0.18, 1e-12);
  EXPECT_NEAR(shown.control, 0.02, 1e-12);
  EXPECT_TRUE(shown.damps());
  EXPECT_FALSE(ripple_verdict({made_up("linear", 80, 0.18, 0.1), made_up("prandtl", 80, 0.2, 0.15)}).damps());
}

// A hollow sphere closes on a sheet of 128 triangles to 0.3 of its radius, with friction.
class ClosingSphere : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(EveryLaw, ClosingSphere, testing::ValuesIn(law_names()), [](const auto& of) {
  std::string name = of.param;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
});

TEST_P(ClosingSphere, CrushesASheetWithoutACrossingAndWithBoundedEnergy) {
  SweepParams choice;
  choice.laws = {GetParam()};
  const Sweep sweep = named_sweeps({"contact"}, choice).front();
  const auto row = std::find(sweep.y.ticks.begin(), sweep.y.ticks.end(), "sphere, friction 0.3");
  ASSERT_NE(row, sweep.y.ticks.end());
  Attempt attempt = sweep.at(0, 0, static_cast<int>(row - sweep.y.ticks.begin()));
  ASSERT_EQ(attempt.scene.law, GetParam());
  attempt.scene.triangles = 128;  // of the program's 300, for time
  attempt.scene.integrator = Integrator::implicit;
  attempt.scene.device = DeviceChoice::cpu;
  attempt.scene.threads = 1;
  const Finding f = probe_stability(attempt, {});
  EXPECT_TRUE(f.outcome == Outcome::ended || f.outcome == Outcome::retried) << f.message;
  EXPECT_LE(f.energy_growth, kLargestGrowth);
  EXPECT_NEAR(f.seconds_simulated, attempt.scene.seconds, attempt.scene.step);
}

TEST(Cells, AreTriedAllOnceByAnyNumberOfThreads) {
  const SweepParams quick{{"semi-implicit"}, {"linear"}, DeviceChoice::cpu, true};
  const std::vector<Sweep> sweeps = named_sweeps({"density-step"}, quick);
  std::vector<SweepCell> one = untried_cells(sweeps, quick), three = one;
  std::size_t calls = 0;
  try_all(one, {0.1, 50}, 1, [&](std::size_t) { ++calls; });
  try_all(three, {0.1, 50}, 3, [](std::size_t) {});
  EXPECT_EQ(calls, one.size());
  for (std::size_t i = 0; i < one.size(); ++i) {
    EXPECT_GT(one[i].finding.steps, 0) << i;
    EXPECT_EQ(one[i].finding.energy_growth, three[i].finding.energy_growth) << i;
  }
}

constexpr int kLimitSteps = 600;

class ExplicitLimit : public testing::TestWithParam<LimitCase> {};
INSTANTIATE_TEST_SUITE_P(Bending, ExplicitLimit, testing::ValuesIn(limit_cases(true)), [](const auto& of) {
  return enum_name(of.param.mesh) + "_" + enum_name(of.param.element) + (of.param.held ? "_held" : "_free");
});

// Linear waves without damping: the limit is 2/omega, of which the program keeps 0.75.
TEST_P(ExplicitLimit, LiesAboveTheBoundByItsMargin) {
  const MeasuredLimit limit = measure_limit(GetParam(), kLimitSteps);
  constexpr double kMargin = 0.75;      // sim/time/simulation.cpp
  constexpr double kResolution = 0.02;  // of the search, and of the power iteration behind the bound
  EXPECT_NEAR(limit.ratio(), 1 / kMargin, kResolution / kMargin);
}

// Numbers of steps that are no multiple of the times the energy is looked at, and fewer than those.
TEST(LimitSearch, FindsTheSameWithAnyNumberOfSteps) {
  constexpr double kMargin = 0.75;      // sim/time/simulation.cpp
  constexpr double kResolution = 0.02;  // of the search, and of the power iteration behind the bound
  for (const int steps : {100, 150, 399}) {
    const MeasuredLimit limit = measure_limit(limit_cases(true).front(), steps);
    EXPECT_FALSE(limit.is_beyond_search) << steps;
    EXPECT_NEAR(limit.ratio(), 1 / kMargin, kResolution / kMargin) << steps;
  }
}

// Where no step is taken no wave grows: the search goes to its end.
TEST(LimitSearch, MarksALimitBeyondItsEnd) {
  const MeasuredLimit limit = measure_limit(limit_cases(true).front(), 0);
  EXPECT_TRUE(limit.is_beyond_search);
  EXPECT_DOUBLE_EQ(limit.ratio(), kMaxRatio);
}

class StabilityCommand : public testing::Test {
 protected:
  int run(std::vector<Flag> flags, bool with_plots = false) {
    flags.insert(flags.end(), {{"quick", true}, {"quiet", true}, {"out", folder_.path().string()}});
    if (!with_plots) flags.push_back({"no-images", true});
    return experiment_named("stability").run({"stability", "hysteron stability", std::move(flags), {}});
  }
  Json manifest() const { return manifest_in(folder_.path()); }
  std::vector<std::string> lines(const char* file) const {
    std::istringstream stream(file_content(folder_.path() / file));
    std::vector<std::string> all;
    for (std::string line; std::getline(stream, line);) all.push_back(line);
    return all;
  }
  Folder folder_;
};

TEST_F(StabilityCommand, WritesARowForEachCellCountsThemAndDrawsAMapOfEachSweep) {
  const std::vector<Flag> flags = {{"sweep", "bending-step,scenes"}, {"integrator", "semi-implicit"}};
  ASSERT_EQ(run(flags, true), 0);
  for (const char* map : {"plot_bending-step.png", "plot_scenes.png"})
    EXPECT_EQ(fs::exists(folder_.path() / map), manifest()["plots_missing"].empty()) << map;
  const std::vector<std::string> rows = lines("cells.csv");
  EXPECT_TRUE(
      rows.front().starts_with("sweep,integrator,variant,x,y,law,element,precision,step [s],outcome,"))
      << rows.front();
  const Json metrics = manifest()["metrics"];
  EXPECT_EQ(metrics["cells"], rows.size() - 1);
  EXPECT_EQ(metrics["cells"], metrics["semi-implicit.cells"]);
  int sum = 0;
  for (const char* outcome : {"ended", "retried", "refused", "diverged"}) sum += metrics[outcome].get<int>();
  EXPECT_EQ(metrics["cells"], sum);
  EXPECT_GT(metrics["ended"], 0);
  EXPECT_GT(metrics["refused"], 0) << "k0 = 0 among the scenes";
  EXPECT_EQ(metrics["diverged_default"], 0) << "no cell of the default integrator was tried";
  const auto refused = std::find_if(rows.begin(), rows.end(),
                                    [](const std::string& row) { return row.find(",refused,") != row.npos; });
  ASSERT_NE(refused, rows.end());
  EXPECT_TRUE(says(*refused, "fabric.k0 = 0")) << "the message stands in the last column";
}

TEST_F(StabilityCommand, MeasuresTheExplicitLimitOnEveryMesh) {
  ASSERT_EQ(run({{"sweep", "explicit-limit"}}), 0);
  EXPECT_EQ(lines("limit.csv").size(), 1 + limit_cases(true).size());
  const Json metrics = manifest()["metrics"];
  EXPECT_GE(metrics["limit_smallest_ratio"], 1) << "the bound is never exceeded";
  EXPECT_LE(metrics["limit_largest_ratio"], 2) << "and never twice too careful";
}

TEST_F(StabilityCommand, RefusesAPartOfALimitStep) {
  EXPECT_TRUE(says(test::refusal([&] {
                     run({{"sweep", "explicit-limit"}, {"limit-steps", 100.5}});
                   }),
                   "limit-steps = 100.5 must be a whole number"));
}

// Its conditions name the sweeps that read a key by patterns.
TEST_F(StabilityCommand, RefusesFlagsThatNoneOfItsSweepsReads) {
  std::vector<std::string> cells;
  for (const Sweep& sweep : named_sweeps({"all"}, {})) cells.push_back(sweep.name);
  ASSERT_GE(cells.size(), 9u);
  const auto is_read = [](const std::string& key, const std::string& sweep) {
    return test::refusal([&] {
             refuse_unread_flags({"stability", "", {{key, "1"}}, {}}, {{"sweep", sweep}, {key, "1"}});
           }) == test::kAccepted;
  };
  for (const char* key : {"device", "seconds", "work"}) {
    for (const std::string& sweep : cells) EXPECT_TRUE(is_read(key, sweep)) << sweep;
    for (const char* sweep : {"ripple", "explicit-limit", "explicit-limit,ripple"})
      EXPECT_FALSE(is_read(key, sweep)) << sweep;
    EXPECT_TRUE(is_read(key, "ripple,mesh"));
  }
  for (const std::string& sweep : cells) {
    EXPECT_TRUE(is_read("integrator", sweep)) << sweep;
    EXPECT_EQ(is_read("law", sweep), sweep != "chapter-method") << sweep;
  }
  EXPECT_FALSE(is_read("law", "chapter-method,explicit-limit"));
  for (const char* key : {"integrator", "law"}) {
    EXPECT_TRUE(is_read(key, "explicit-limit,ripple"));
    EXPECT_FALSE(is_read(key, "explicit-limit"));
  }
}

TEST_F(StabilityCommand, RefusesNamesThatAreUnknownOrStandTwice) {
  const auto said = [&](const char* key, const char* list) {
    return test::refusal([&] {
      std::vector<Flag> flags = {{key, list}};
      if (key != std::string("sweep")) flags.push_back({"sweep", "mesh"});
      run(std::move(flags));
    });
  };
  EXPECT_TRUE(says(said("law", "linear,prandl"), "law = prandl must be "));
  EXPECT_TRUE(says(said("law", "prandtl,all"), "law = all must be "));
  EXPECT_TRUE(says(said("integrator", "bdf3"), "integrator = bdf3 must be "));
  EXPECT_TRUE(says(said("law", "wong,wong"), "law = wong,wong names wong twice (--law)"));
  EXPECT_TRUE(says(said("integrator", "bdf2,bdf2"), "names bdf2 twice"));
  EXPECT_TRUE(says(said("sweep", "ripple,ripple"), "names ripple twice"));
  EXPECT_TRUE(says(said("sweep", "all,ripple"), "all stands alone"));
  EXPECT_TRUE(says(said("sweep", ","), "must be "));
}

TEST_F(StabilityCommand, TakesAllLawsByOneName) {
  constexpr double kNoTime = 1;  // a step of each cell
  ASSERT_EQ(
      run({{"sweep", "density-step"}, {"integrator", "semi-implicit"}, {"law", "all"}, {"work", kNoTime}}),
      0);
  EXPECT_EQ(manifest()["metrics"]["cells"], law_names().size() * 2 * 2) << "two densities, two steps";
}

}  // namespace
}  // namespace hysteron::experiments
