// Implicit steps in motion: order, independence of the solver's details, stiff and long runs, losses.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "sim/base/error.h"
#include "sim/bending/laws/law_parameters.h"
#include "tests/sim/time/scenes.h"

namespace hysteron {
namespace {

using test::Positions;
using test::Trial;

// A soft sheet that swings and shakes: its fastest membrane wave has a period of some 10 ms, so that steps of
// a millisecond resolve everything.
Scene soft_sheet(const std::string& law, const std::string& integrator, double step) {
  Scene scene = test::hanging_square(40);
  scene.law = law;
  scene.integrator = value_named<Integrator>(integrator);
  scene.step = step;
  scene.fabric.warp = scene.fabric.weft = 10;
  scene.fabric.shear = 3;
  scene.fabric.b1 *= 10;
  scene.fabric.b2 *= 10;
  scene.fabric.k0 = 5;
  scene.newton_residual = 1e-11;
  scene.newton_velocity = 0;
  return scene;
}

Positions shape_after(const Scene& scene, double seconds) {
  return test::rippled(scene, 5e-3).at(seconds)->positions();
}

struct OrderCase {
  std::string law, integrator;
  double order;
  std::string name() const { return test::Method{law, "shape", integrator}.name(); }
};
class Order : public testing::TestWithParam<OrderCase> {};
const OrderCase kOrderCases[] = {{"linear", "implicit", 1},  {"linear", "bdf2", 2},
                                 {"prandtl", "implicit", 1}, {"prandtl", "bdf2", 2},
                                 {"linear", "tr-bdf2", 2},   {"prandtl", "tr-bdf2", 2}};

INSTANTIATE_TEST_SUITE_P(Integrators, Order, testing::ValuesIn(kOrderCases), test::CaseName());

// Against symplectic steps of 10 us, for a time in which the cloth bends and unbends.
TEST_P(Order, AgreesWithTinyExplicitStepsThroughReversals) {
  constexpr double kSeconds = 0.064, kTiny = 1e-6;
  const OrderCase& c = GetParam();
  const Positions exact = shape_after(soft_sheet(c.law, "explicit", kTiny), kSeconds);
  const auto error = [&](double step) {
    return test::farthest(shape_after(soft_sheet(c.law, c.integrator, step), kSeconds), exact);
  };
  const double step = c.order == 1 ? 0.1e-3 : 0.4e-3;
  const double coarse = error(step), fine = error(step / 2);
  EXPECT_GT(fine, 0);
  EXPECT_GT(std::log2(coarse / fine), c.order - 0.25);
}

// Returns a strip held at its left end, bending by its own weight.
Scene cantilever(const std::string& law, const std::string& integrator) {
  Scene scene = test::free_square(120);
  scene.cloth.shape = ClothOutline::strip;
  scene.cloth.length = 0.06;
  scene.cloth.width = 0.02;
  scene.law = law;
  scene.integrator = value_named<Integrator>(integrator);
  scene.pin = {test::pin_in({-1, -1, -1}, {0.0101, 1, 1})};
  return scene;
}

double tip_drop(const Scene& scene, int steps) {
  const Trial trial(scene);
  double lowest = 0;
  for (const Eigen::Vector3d& x : trial.after(steps)->positions()) lowest = std::min(lowest, x.z());
  return -lowest;
}

TEST(StiffPaper, StaysFiniteForAThousandLargeSteps) {
  Scene scene = test::hanging_square(60);
  scene.fabric.b1 = scene.fabric.b2 = 4e-4;
  scene.fabric.density = 0.1;
  scene.fabric.warp = scene.fabric.weft = 1e4;
  for (const char* integrator : {"implicit", "bdf2", "tr-bdf2"}) {
    scene.integrator = value_named<Integrator>(integrator);
    scene.step = 1.0 / 24;
    const auto simulation = Trial(scene).after(1000);
    for (const Eigen::Vector3d& x : simulation->positions()) {
      ASSERT_TRUE(x.allFinite());
      EXPECT_LT(x.norm(), 1);
    }
    EXPECT_LT(simulation->largest_stretch(), 0.05);
  }
}

TEST(NewtonIterations, BeyondTheToleranceDoNotMatter) {
  Scene scene = test::hanging_square(100);
  scene.law = "prandtl";
  scene.integrator = Integrator::implicit;
  scene.step = 1.0 / 60;
  scene.newton_velocity = 0;
  const auto shape = [&](double residual) {
    scene.newton_residual = residual;
    return test::rippled(scene, 3e-3).after(15)->positions();
  };
  const Positions exact = shape(1e-12), usual = shape(1e-6), loose = shape(1e-3);
  EXPECT_LT(test::farthest(usual, exact), 1e-6);  // [m]
  EXPECT_GT(test::farthest(loose, exact), test::farthest(usual, exact));
}

TEST(Friction, NeverGivesEnergyBackInAnyImplicitStep) {
  for (const LawEntry& law : law_catalogue()) {
    if (std::string(law.name) == "wong") continue;  // it may: tests/sim/bending/wong_test.cpp
    Scene scene = test::hanging_square(40);
    scene.law = law.name;
    scene.integrator = Integrator::implicit;
    scene.step = 1.0 / 60;
    scene.fabric.k0 = 5;
    const Trial trial = test::rippled(scene, 5e-3);
    const auto simulation = trial.simulation();
    double last = 0;
    for (int step = 0; step < 20; ++step) {
      simulation->advance(1);
      const Ledger ledger = simulation->ledger();
      EXPECT_GE(ledger.bending_friction, last * (1 - 1e-12)) << law.name << " " << step;
      EXPECT_GE(ledger.inertia, 0) << law.name;
      last = ledger.bending_friction;
    }
  }
}

// The minimum of a step is where it is, however the linear systems on the way to it are solved: of a stiff
// cloth.  A limp one buckles, each way to do so is a minimum, and rounding chooses.
TEST(LinearSolvers, LeadToTheSameMotion) {
  constexpr double kSame = 1e-9;  // [m]
  test::Positions ends[2];
  for (int k = 0; k < 2; ++k) {
    Scene scene = test::hanging_square(200);
    scene.law = "prandtl";
    scene.integrator = Integrator::implicit;
    scene.step = 5e-3;
    scene.fabric.b1 *= 100;
    scene.fabric.b2 *= 100;
    scene.newton_residual = 1e-10;
    scene.newton_velocity = 0;
    scene.linear_solver = k == 0 ? Preconditioning::multigrid : Preconditioning::block_jacobi;
    const Trial trial = test::rippled(scene, 1e-3);
    const auto simulation = trial.after(40);
    ends[k] = simulation->positions();
    EXPECT_GT(test::farthest(ends[k], trial.cloth.start), 1e-2);
  }
  EXPECT_LT(test::farthest(ends[0], ends[1]), kSame);
}

TEST(QuasiStatic, FindsTheEquilibriumThatDampedMotionFinds) {
  Scene still = cantilever("linear", "quasi-static"), moving = cantilever("linear", "implicit");
  still.step = 0.25;
  still.ramp = 1;
  moving.step = 0.02;
  moving.air_drag = 2;
  const double equilibrium = tip_drop(still, 4), settled = tip_drop(moving, 400);
  EXPECT_GT(equilibrium, 5e-3);
  EXPECT_NEAR(settled, equilibrium, 0.01 * equilibrium);
}

// With friction the way decides where cloth rests: slow loading finds the first equilibrium that it meets.
TEST(QuasiStatic, FindsWithHysteresisTheEquilibriumOfSlowLoading) {
  Scene still = cantilever("prandtl", "quasi-static"), moving = cantilever("prandtl", "implicit");
  still.step = 0.05;
  still.ramp = 1;
  moving.step = 0.02;
  moving.air_drag = 40;  // no swing beyond the equilibrium
  const double equilibrium = tip_drop(still, 20), settled = tip_drop(moving, 3000);
  EXPECT_NEAR(settled, equilibrium, 0.01 * equilibrium);
}

TEST(QuasiStatic, BooksTheWeightThatTheHandStillCarries) {
  Scene scene = cantilever("prandtl", "quasi-static");
  scene.step = 0.1;
  scene.ramp = 1;
  const Ledger ledger = Trial(scene).after(10)->ledger();
  EXPECT_LT(ledger.gravitational, 0);
  EXPECT_LT(ledger.pin_work, 0);
  EXPECT_LT(ledger.remainder_relative, 1e-5);
}

// The whole scene, weight included, turned in space: the motion turns with it.
TEST(Turned, SceneMovesAlike) {
  const Eigen::Matrix3d turn = (Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized()) *
                                Eigen::AngleAxisd(2.1, Eigen::Vector3d::UnitX()))
                                   .toRotationMatrix();
  const auto moved = [&](const Eigen::Matrix3d& rotation) {
    Scene scene = test::hanging_square(40);
    scene.law = "prandtl";
    scene.integrator = Integrator::bdf2;
    scene.step = 1.0 / 120;
    scene.fabric.k0 = 5;
    scene.newton_residual = 1e-11;
    scene.newton_velocity = 0;
    scene.gravity = rotation * scene.gravity;
    Trial trial = test::rippled(scene, 5e-3);
    for (Eigen::Vector3d& x : trial.cloth.start) x = rotation * x;
    return trial.after(12)->positions();
  };
  const Positions plain = moved(Eigen::Matrix3d::Identity());
  Positions back = moved(turn);
  for (Eigen::Vector3d& x : back) x = turn.transpose() * x;
  EXPECT_LT(test::farthest(plain, back), 1e-8);
  EXPECT_GT(test::farthest(plain, Trial(test::hanging_square(40)).cloth.start), 0.02) << "nothing moved";
}

TEST(Tolerance, TighterTakesMorePartsAndComesNearer) {
  for (const char* integrator : {"bdf2", "tr-bdf2", "semi-implicit"}) {
    const Positions exact = shape_after(soft_sheet("prandtl", "bdf2", 0.05e-3), 0.064);
    double last_error = 1e30;
    long last_parts = 0;
    for (double tolerance : {1e-4, 1e-5, 1e-6}) {
      Scene scene = soft_sheet("prandtl", integrator, 0.016);
      scene.tolerance = tolerance;
      const Trial trial = test::rippled(scene, 5e-3);
      const auto simulation = trial.after(4);
      const double error = test::farthest(simulation->positions(), exact);
      EXPECT_LT(error, last_error) << integrator << " " << tolerance;
      EXPECT_GT(simulation->counts().parts, last_parts);
      last_error = error;
      last_parts = simulation->counts().parts;
    }
  }
}

// The first step of bdf2 is backward Euler's; tr-bdf2 starts itself once it knows an acceleration.
TEST(TrBdf2, LosesLessThanBdf2AtTwiceTheStep) {
  const auto loss = [](const std::string& integrator, double step) {
    return test::rippled(soft_sheet("linear", integrator, step), 5e-3).at(0.064)->ledger().integrator();
  };
  EXPECT_GT(loss("tr-bdf2", 0.8e-3), 0);
  EXPECT_LT(loss("tr-bdf2", 0.8e-3), loss("bdf2", 0.4e-3));
}

// Under its weight alone every step is exact: x = g t^2/2, from the second one on also for the stages.
TEST(TrBdf2, FallsFreelyAsGalileo) {
  Scene scene = test::free_square(40);
  scene.integrator = Integrator::tr_bdf2;
  scene.step = 1.0 / 240;
  scene.air_drag = 0;
  const auto simulation = Trial(scene).after(24);
  const double t = simulation->time(), g = -scene.gravity.z();
  const double first =
      (2 - std::sqrt(2.0)) * scene.step;  // a stage by backward Euler: too far by g first^2/2
  const double speed = -simulation->velocities()[0].z();
  EXPECT_NEAR(speed / (g * t), 1, 1e-9);
  const double fallen = Trial(scene).cloth.start[0].z() - simulation->positions()[0].z();
  EXPECT_NEAR(fallen, g * t * t / 2, g * first * first);
  EXPECT_GT(fallen, g * t * t / 2);
}

// The acceleration of a fall in air changes by a share drag h of itself from step to step, and that change by
// as small a share.  An extrapolated acceleration therefore misses the weight by (drag h)^2, less than the
// residual that ends a step; that of the step before would miss it by drag h, and cost an iteration a step.
TEST(Implicit, GoesOnWithAnAccelerationThatChangesSmoothly) {
  Scene scene = test::free_square(40);
  scene.integrator = Integrator::implicit;
  scene.step = 1e-3;
  scene.air_drag = 0.1 * scene.fabric.density;  // [kg/(m^2 s)]
  scene.newton_velocity = 0;
  scene.newton_residual = 1e-6;
  const auto simulation = Trial(scene).after(5);
  const long before = simulation->counts().newton;
  constexpr int kSteps = 20;
  simulation->advance(kSteps);
  EXPECT_LT(simulation->counts().newton - before, kSteps / 2);
}

// Clamps that jump by a quarter turn within one step of 1/24 s.
TEST(FailedStep, IsTakenAgainInHalvesAndCounted) {
  Scene scene = cantilever("prandtl", "implicit");
  scene.step = 1.0 / 24;
  Pin far = scene.pin[0];
  far.low = {0.05, -1, -1};
  far.high = {1, 1, 1};
  far.motion.axis = {1, 0, 0};
  far.motion.keys = {{0, {0, 0, 0}, 0}, {1.0 / 24, {-0.02, 0, 0.02}, 900}, {1, {-0.02, 0, 0.02}, 900}};
  scene.pin.push_back(far);
  const auto simulation = Trial(scene).after(3);
  for (const Eigen::Vector3d& x : simulation->positions()) ASSERT_TRUE(x.allFinite());
  EXPECT_GE(simulation->counts().parts, 3 + simulation->counts().retried);
}

TEST(Implicit, RefusesWhatHasNoPotentialOrNoErrorEstimate) {
  Scene chapter = test::hanging_square();
  chapter.integrator = Integrator::implicit;
  chapter.element = BendingElement::hinge;
  chapter.force = ForceConvention::chapter;
  EXPECT_THROW(Trial(chapter).simulation(), Error);
}

}  // namespace
}  // namespace hysteron
