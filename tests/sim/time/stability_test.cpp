// The stated bound on the explicit step: not too optimistic, not needlessly small, and enforced.
#include <gtest/gtest.h>

#include <random>

#include "sim/time/back_end.h"
#include "tests/sim/base/refusal.h"
#include "tests/sim/time/scenes.h"

namespace hysteron {
namespace {

using test::Trial;

// Margin between the stated step and 2/omega (sim/solve/simulation.cpp).
constexpr double kMargin = 0.75;

Scene unloaded(const std::string& element, const std::string& law) {
  Scene scene = test::free_square(100);
  scene.gravity.setZero();
  scene.fabric.damping = 0;
  scene.element = value_named<BendingElement>(element);
  scene.law = law;
  return scene;
}

// Every vertex shaken by a fraction of an edge: every mode has a share.
void shake(Cloth& cloth, double amplitude) {
  std::mt19937 generator(12);
  std::uniform_real_distribution<double> uniform(-amplitude, amplitude);
  for (auto& x : cloth.start) x.z() += uniform(generator);
}

double energy(Simulation& simulation) {
  const Ledger l = simulation.ledger();
  return l.kinetic + l.membrane + l.bending;
}

class StepBound : public testing::TestWithParam<test::Method> {};
const test::Method kBoundCases[] = {
    {"linear", "shape", "semi-implicit"},  {"prandtl", "shape", "semi-implicit"},
    {"wong", "shape", "semi-implicit"},    {"linear", "hinge", "semi-implicit"},
    {"prandtl", "hinge", "semi-implicit"}, {"linear", "shape", "explicit"},
    {"prandtl", "hinge", "explicit"}};

INSTANTIATE_TEST_SUITE_P(Cases, StepBound, testing::ValuesIn(kBoundCases), test::CaseName());

// The step is the largest one that the simulation itself chooses; 2,000 of them are some hundred periods.
TEST_P(StepBound, KeepsAShakenSheetBounded) {
  Scene scene = unloaded(GetParam().element, GetParam().law);
  scene.integrator = value_named<Integrator>(GetParam().integrator);
  Trial trial(scene);
  const StepLimits limits = trial.simulation()->limits();
  trial.scene.step =
      scene.integrator == Integrator::explicit_euler ? limits.membrane_step : limits.bending_step;
  shake(trial.cloth, 2e-4);
  const auto simulation = trial.simulation();
  ASSERT_EQ(simulation->limits().substeps, 1);
  const double initial = energy(*simulation);
  ASSERT_GT(initial, 0);
  // Near the bound symplectic Euler conserves a neighbouring energy, up to 1/(1 - kMargin^2) times the true
  // one.
  constexpr double kNeighbour = 1 / (1 - kMargin * kMargin);
  for (int i = 0; i < 10; ++i) {
    simulation->advance(200);
    ASSERT_LT(energy(*simulation), kNeighbour * initial) << i;
  }
}

// The step is half as large again as 2/omega, past the check: the highest mode grows by (7 + sqrt(45))/2 =
// 6.9 a step.
TEST(StepBound, IsNotNeedlesslySmall) {
  for (const char* element : {"shape", "hinge"}) {
    Trial trial(unloaded(element, "linear"));
    shake(trial.cloth, 1e-6);
    StepLimits limits = trial.simulation()->limits();
    trial.scene.step = 1.5 * limits.bending_step / kMargin;
    limits.substeps = 1;
    limits.substep = trial.scene.step;
    const CurvatureOperator op = make_curvature_operator(value_named<BendingElement>(element),
                                                         trial.cloth.mesh, trial.cloth.held(trial.scene, 0));
    const auto simulation = make_cpu_simulation(trial.scene, trial.cloth, op, limits);
    const double initial = energy(*simulation);
    simulation->advance(12);
    EXPECT_GT(energy(*simulation), 1e3 * initial) << element;
  }
}

TEST(Substeps, FewerThanTheLeastStableAreRefusedWithThatNumber) {
  Trial trial(test::hanging_square(2000));
  trial.scene.law = "prandtl";
  trial.scene.step = 4e-3;
  const int least = trial.simulation()->limits().substeps;
  ASSERT_GT(least, 2);
  trial.scene.substeps = least;
  EXPECT_EQ(trial.simulation()->limits().substeps, least);
  trial.scene.substeps = least - 1;
  EXPECT_TRUE(test::says(test::refusal([&] { trial.simulation(); }),
                         "substeps = " + std::to_string(least - 1), "at least " + std::to_string(least)));
}

TEST(Substeps, MoreThanTheLeastAreTaken) {
  Trial trial(test::hanging_square());
  trial.scene.substeps = 7;
  const StepLimits limits = trial.simulation()->limits();
  EXPECT_EQ(limits.substeps, 7);
  EXPECT_DOUBLE_EQ(limits.substep, trial.scene.step / 7);
}

// omega ~ sqrt(b1/sigma)/h^2: half the edge takes four times the substeps, four times b1 half the step.
TEST(Substeps, FollowTheLargestFrequencyOfBending) {
  const auto step = [](int cells, double b1) {
    Scene scene = test::free_square();
    scene.mesh = "aligned";
    scene.triangles = 2 * cells * cells;
    scene.law = "prandtl";
    scene.fabric.damping = 0;
    scene.fabric.b1 = b1;
    return Trial(scene).simulation()->limits().bending_step;
  };
  constexpr double kPowerIteration =
      0.02;  // stops at a change of 1e-4 per product; edges weigh more on coarse meshes
  EXPECT_NEAR(step(10, 4e-5) / step(20, 4e-5), 4, 4 * kPowerIteration);
  EXPECT_NEAR(step(10, 4e-5) / step(10, 16e-5), 2, 2 * kPowerIteration);
}

// The membrane's force grows with the cube of the deflection, so that an unstable explicit step overflows.
TEST(Divergence, IsReportedAsAFailedRunWithTheStep) {
  Trial trial(unloaded("shape", "linear"));
  trial.scene.integrator = Integrator::explicit_euler;
  shake(trial.cloth, 1e-3);
  StepLimits limits = trial.simulation()->limits();
  limits.substeps = 1;
  limits.substep = trial.scene.step = 3 * limits.membrane_step;
  const CurvatureOperator op =
      make_curvature_operator(BendingElement::shape, trial.cloth.mesh, trial.cloth.held(trial.scene, 0));
  const auto simulation = make_cpu_simulation(trial.scene, trial.cloth, op, limits);
  EXPECT_TRUE(test::says(test::refusal([&] { simulation->advance(100); }, 3), "smaller step"));
}

}  // namespace
}  // namespace hysteron
