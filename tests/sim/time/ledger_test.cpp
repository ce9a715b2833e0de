// The energy ledger closes, and its integrator's losses shrink with the step.
#include <gtest/gtest.h>

#include <numeric>

#include "sim/base/error.h"
#include "tests/sim/time/scenes.h"

namespace hysteron {
namespace {

using test::Trial;

// Remainder over the sum of the terms: rounding of some hundred vertices over some thousand substeps.
constexpr double kClosed = 1e-9;

Scene law_scene(const std::string& law, const std::string& integrator) {
  Scene scene = test::hanging_square();
  scene.law = law;
  scene.integrator = value_named<Integrator>(integrator);
  scene.newton_residual = 1e-11;
  scene.newton_velocity = 0;
  return scene;
}

class Balance : public testing::TestWithParam<test::Method> {};
const test::Method kLedgerCases[] = {{"linear", "shape", "semi-implicit"},  {"linear", "shape", "explicit"},
                                     {"prandtl", "shape", "semi-implicit"}, {"prandtl", "shape", "explicit"},
                                     {"wong", "shape", "semi-implicit"},    {"pabst", "shape", "explicit"},
                                     {"prandtl", "shape", "implicit"},      {"prandtl", "shape", "bdf2"},
                                     {"prandtl", "shape", "tr-bdf2"},       {"wong", "shape", "tr-bdf2"},
                                     {"kim", "shape", "implicit"},          {"wong", "shape", "bdf2"},
                                     {"prandtl", "shape", "quasi-static"}};

INSTANTIATE_TEST_SUITE_P(Cases, Balance, testing::ValuesIn(kLedgerCases), test::CaseName());

// Cloth that starts bent has the history of its bend, which has lost nothing of the run.
TEST(BalanceOfABentStart, HasLostNothingBeforeItsFirstStep) {
  for (const char* law : {"prandtl", "wong", "narain", "chapman"}) {
    const Ledger start = test::rippled(law_scene(law, "implicit"), 2e-2).simulation()->ledger();
    EXPECT_GT(start.bending, 0) << law;
    EXPECT_EQ(start.bending_friction, 0) << law;
    EXPECT_EQ(start.bending_relaxation, 0) << law;
    EXPECT_EQ(start.integrator(), 0) << law;
  }
}

TEST(IntegratorShare, IsThatOfLossesAboveRounding) {
  Ledger ledger;
  ledger.kinetic = 1e-5, ledger.inertia = 8e-20;
  EXPECT_EQ(ledger.integrator_share(), 0);
  ledger.inertia = 1e-9, ledger.viscous = 3e-9;
  EXPECT_DOUBLE_EQ(ledger.integrator_share(), 0.25);
}

TEST_P(Balance, ClosesForASwingingCloth) {
  Scene scene = law_scene(GetParam().law, GetParam().integrator);
  scene.fabric.damping = 0;
  const Trial trial = test::rippled(scene, 3e-3);
  const Ledger ledger = trial.after(scene.is_implicit() ? 20 : 100)->ledger();
  if (scene.integrator != Integrator::quasi_static) {
    EXPECT_GT(ledger.kinetic, 0);
  }
  EXPECT_LT(ledger.remainder_relative, kClosed);
  EXPECT_EQ(ledger.viscous, 0);
  EXPECT_EQ(ledger.pin_work, 0);
}

TEST_P(Balance, ClosesWithDampingAirMovingHandleMovingObstacleAndARelease) {
  Scene scene = law_scene(GetParam().law, GetParam().integrator);
  if (scene.integrator == Integrator::explicit_euler) {
    scene.step = 1e-4;  // the barrier is stiff
    scene.contact_stiffness = 1e6;
  }
  const bool statics = scene.integrator == Integrator::quasi_static;
  if (statics) scene.step = 0.01;
  scene.air_drag = 0.05;
  scene.pin[0].motion.keys = {{0, {0, 0, 0}, 0}, {0.05, {0.02, 0.03, 0.01}, 20}};
  if (!statics) scene.pin[1].until = 0.03;
  Obstacle sphere = test::sphere_at({0.1, 0.1, -0.045}, 0.04);
  sphere.motion.keys = {{0, {0, 0, 0}, 0}, {0.05, {0.01, 0, 0.02}, 30}};
  scene.obstacle = {sphere};
  const Trial trial(scene);
  const Ledger ledger = trial.at(0.06)->ledger();
  EXPECT_GT(ledger.obstacle_work, 0);
  EXPECT_GT(ledger.contact_friction, 0);
  if (!statics) {
    EXPECT_GT(ledger.viscous, 0);
    EXPECT_GT(ledger.air, 0);
  }
  EXPECT_NE(ledger.pin_work, 0);
  EXPECT_LT(ledger.remainder_relative, kClosed);
}

TEST(Ledger, ClosesForClothFallingOnTheGround) {
  for (const char* law : {"prandtl", "wong"}) {
    Scene scene = test::free_square();
    scene.law = law;
    scene.obstacle = {test::ground_at(-0.02)};
    scene.cloth.rotation = {20, 10, 0};
    scene.cloth.position = {0, 0, 0.02};
    const Ledger ledger = Trial(scene).after(150)->ledger();
    EXPECT_GT(ledger.contact_friction, 0) << law;
    EXPECT_GT(ledger.bending_friction, 0) << law;
    EXPECT_LT(ledger.remainder_relative, kClosed) << law;
  }
}

// A moving cloth is brought to rest: nothing moves any more, and its kinetic energy is booked.
TEST(Ledger, ClosesWhenAMotionIsEndedAtItsEquilibrium) {
  for (const char* integrator : {"implicit", "bdf2"}) {
    const Trial trial = test::rippled(law_scene("prandtl", integrator), 3e-3);
    const auto simulation = trial.after(20);
    ASSERT_GT(simulation->ledger().kinetic, 0);
    simulation->become_static();
    simulation->advance(4);
    const std::vector<Eigen::Vector3d> before = simulation->positions();
    simulation->advance(1);
    const std::vector<Eigen::Vector3d> x = simulation->positions();
    for (std::size_t i = 0; i < x.size(); ++i) EXPECT_LT((x[i] - before[i]).norm(), 1e-9) << integrator;
    const Ledger ledger = simulation->ledger();
    EXPECT_EQ(ledger.kinetic, 0);
    EXPECT_LT(ledger.remainder_relative, kClosed) << integrator;
  }
}

TEST(Equilibrium, IsNotForIntegratorsThatAreExplicitInBending) {
  Trial trial(law_scene("prandtl", "semi-implicit"));
  EXPECT_THROW(trial.after(1)->become_static(), Error);
}

// Flat cloth in free fall: kinetic energy m v^2/2 with v = g t; the height lost is g t (t + he)/2 (symplectic
// Euler), so that the integrator's loss is m g^2 t he/2, all of it inertia.
TEST(Ledger, OfFreeFallIsItsClosedForm) {
  const Trial trial(test::free_square());
  const auto simulation = trial.after(40);
  const Ledger ledger = simulation->ledger();
  const double t = simulation->time(), he = simulation->limits().substep, g = -trial.scene.gravity.z();
  const double mass = trial.scene.fabric.density * 0.2 * 0.2;
  constexpr double kRounding = 1e-9;
  EXPECT_NEAR(ledger.kinetic / (mass / 2 * g * g * t * t), 1, kRounding);
  EXPECT_NEAR(ledger.gravitational / (-mass * g * g * t * (t + he) / 2), 1, kRounding);
  EXPECT_NEAR(ledger.inertia / (mass * g * g * t * he / 2), 1, kRounding);
  EXPECT_NEAR(ledger.integrator() / ledger.inertia, 1, kRounding);
}

// Integrator's loss of a cloth swinging from its corners, at the same time with half the step.
double loss_order(const std::string& integrator, double step, double damping) {
  double loss[2];
  for (int level = 0; level < 2; ++level) {
    Scene scene = law_scene("linear", integrator);
    scene.triangles = 50;
    scene.step = step / (1 << level);
    scene.fabric.damping = damping;
    scene.fabric.warp = scene.fabric.weft = 20;  // soft: the step resolves every wave
    scene.fabric.shear = 5;
    loss[level] = Trial(scene).at(0.1)->ledger().integrator();
  }
  EXPECT_NE(loss[1], 0);
  return std::log2(std::abs(loss[0] / loss[1]));
}

TEST(Ledger, IntegratorsLossShrinksWithFirstOrderInTheStep) {
  constexpr double kSlack = 0.15;  // the next order of the step
  EXPECT_NEAR(loss_order("explicit", 4e-5, 1e-4), 1, kSlack);
  EXPECT_NEAR(loss_order("semi-implicit", 1e-4, 1e-4), 1, kSlack);
}

// A corner is pulled away, without weight, through equilibria: the pin's work is stored, but for what the
// mean of the forces over a step misses.
TEST(Ledger, OfEquilibriaMissesWorkWithSecondOrderInTheStep) {
  double missed[2], stored = 0;
  for (int level = 0; level < 2; ++level) {
    Scene scene = law_scene("linear", "quasi-static");
    scene.gravity.setZero();
    scene.step = 0.01 / (1 << level);
    scene.pin[0].motion.keys = {{0, {0, 0, 0}, 0}, {0.1, {-0.004, 0.003, 0.002}, 0}};
    const Ledger ledger = Trial(scene).after(10 << level)->ledger();
    missed[level] = std::abs(ledger.integrator());
    stored = ledger.membrane + ledger.bending;
    EXPECT_NEAR(ledger.pin_work / stored, 1, 0.02);
  }
  constexpr double kSlack = 0.3;  // the next order of ten and twenty steps
  EXPECT_GT(missed[1], 1e-9 * stored);
  EXPECT_NEAR(std::log2(missed[0] / missed[1]), 2, kSlack);
}

// Backward Euler takes all from a cloth without friction, air and viscosity, and the less beside friction's
// part the shorter the steps are.
TEST(Ledger, SharesWhatWasDissipatedBetweenTheIntegratorAndTheCloth) {
  const auto fraction = [](const std::string& law, double step) {
    Scene scene = law_scene(law, "implicit");
    scene.step = step;
    scene.air_drag = scene.fabric.damping = 0;
    return test::rippled(scene, 3e-3).at(0.02)->ledger().integrator_share();
  };
  EXPECT_EQ(fraction("linear", 1e-3), 1);
  const double coarse = fraction("prandtl", 1e-3), fine = fraction("prandtl", 2.5e-4);
  EXPECT_GT(fine, 0);
  EXPECT_LT(fine, coarse);
  EXPECT_LT(coarse, 1);
  EXPECT_EQ(Ledger{}.integrator_share(), 0);
}

TEST(Ledger, AccountsAreThoseOfTheLaw) {
  const auto of = [](const std::string& law) {
    return test::rippled(law_scene(law, "semi-implicit"), 3e-3).after(50)->ledger();
  };
  EXPECT_EQ(of("linear").bending_friction, 0);
  EXPECT_EQ(of("pabst").bending_friction, 0);
  EXPECT_GT(of("prandtl").bending_friction, 0);
  EXPECT_EQ(of("prandtl").contact_friction, 0);
}

TEST(Ledger, RowsAddUpToTheRemainder) {
  Trial trial(law_scene("prandtl", "semi-implicit"));
  const Ledger ledger = trial.after(30)->ledger();
  double sum = 0, remainder = 0;
  for (const auto& [name, value] : ledger.rows()) {
    const bool given = name == "initial" || name == "handle_work" || name == "obstacle_work";
    if (name == "remainder")
      remainder = value;
    else
      sum += given ? -value : value;
  }
  EXPECT_NEAR(sum, remainder, 1e-15);  // joules, of terms of about 1e-3 J
}

}  // namespace
}  // namespace hysteron
