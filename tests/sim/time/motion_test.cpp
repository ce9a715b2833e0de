// Momentum, pins that hold and pins that move, and invariance of whole steps.
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "sim/scene/motion.h"
#include "tests/sim/time/scenes.h"

namespace hysteron {
namespace {

using Eigen::Vector3d;
using test::Momenta;
using test::momenta;
using test::Trial;

constexpr double kMotionRounding = 1e-12;
// Two correctly solved steps differ by the solver's tolerance, amplified over tens of steps.
constexpr double kSolved = 1e-9;

class TwoIntegrators : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Both, TwoIntegrators, testing::Values("semi-implicit", "explicit"),
                         test::CaseName());

TEST_P(TwoIntegrators, FreeFallGainsExactlyTheWeightsMomentum) {
  for (const char* law : {"linear", "prandtl", "wong"}) {
    Scene scene = test::free_square();
    scene.integrator = value_named<Integrator>(GetParam());
    scene.law = law;
    const Trial trial = test::rippled(scene, 3e-3);
    const auto simulation = trial.after(50);
    const Momenta sum = momenta(trial, *simulation);
    const Vector3d expected = sum.mass * scene.gravity * simulation->time();
    EXPECT_LT((sum.linear - expected).norm(), kSolved * expected.norm()) << law;
  }
}

// v_n = n he g and x_n = x_0 + he sum v_k: the centre falls by g t (t + he)/2.
TEST_P(TwoIntegrators, FlatClothFallsAsAPoint) {
  Scene scene = test::free_square();
  scene.integrator = value_named<Integrator>(GetParam());
  const Trial trial(scene);
  const auto simulation = trial.after(50);
  const double t = simulation->time(), he = simulation->limits().substep;
  const Vector3d fall = scene.gravity * t * (t + he) / 2;
  test::Positions expected;
  for (const Vector3d& x : trial.cloth.start) expected.push_back(x + fall);
  EXPECT_LT(test::farthest(simulation->positions(), expected), 10 * kMotionRounding);
}

TEST(ExplicitIntegrator, KeepsAngularMomentumOfATumblingCloth) {
  Scene scene = test::free_square();
  scene.integrator = Integrator::explicit_euler;
  scene.law = "prandtl";
  scene.gravity.setZero();
  const Trial trial = test::rippled(scene, 3e-3);
  const auto simulation = trial.after(50);
  const Momenta sum = momenta(trial, *simulation);
  const double scale = 0.2 * sum.size;  // levers of the cloth's size
  ASSERT_GT(scale, 0);
  EXPECT_LT(sum.angular.norm(), kMotionRounding * scale * simulation->limits().substeps);
}

// One linearised implicit solve turns with the cloth only to first order of the step.
TEST(SemiImplicitIntegrator, AngularMomentumErrorShrinksWithTheStep) {
  const auto error = [](double step) {
    Scene scene = test::free_square();
    scene.gravity.setZero();
    scene.step = step;
    const Trial trial = test::rippled(scene, 3e-3);
    const auto simulation = trial.at(0.02);
    const Momenta sum = momenta(trial, *simulation);
    return sum.angular.norm() / (0.2 * sum.size);
  };
  const double coarse = error(1e-3), fine = error(2.5e-4);
  constexpr double kNoticed = 0.05;
  EXPECT_LT(coarse, kNoticed);
  EXPECT_LT(fine, coarse / 2);
}

TEST_P(TwoIntegrators, StepTurnsWithTheWorld) {
  for (const char* law : {"linear", "prandtl", "wong"}) {
    Scene scene = test::hanging_square();
    scene.integrator = value_named<Integrator>(GetParam());
    scene.law = law;
    const Trial trial = test::rippled(scene, 3e-3);
    Trial turned = trial;
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(1.9, Vector3d(1, -2, 2).normalized()).toRotationMatrix();
    const auto move = [&](const Vector3d& x) { return Vector3d(turn * x + Vector3d(0.3, 0.1, -0.5)); };
    turned.scene.gravity = turn * scene.gravity;
    for (Vector3d& x : turned.cloth.start) x = move(x);
    test::Positions expected = trial.after(30)->positions();
    for (Vector3d& x : expected) x = move(x);
    EXPECT_GT(test::farthest(expected, turned.cloth.start), 1e-3);
    EXPECT_LT(test::farthest(turned.after(30)->positions(), expected), kSolved) << law;
  }
}

TEST_P(TwoIntegrators, PinsStayWhereTheyAreToTheLastBit) {
  Scene scene = test::hanging_square();
  scene.integrator = value_named<Integrator>(GetParam());
  const Trial trial(scene);
  const auto x = trial.after(50)->positions();
  int pinned = 0;
  for (std::size_t i = 0; i < x.size(); ++i)
    if (trial.cloth.pin[i] >= 0) {
      EXPECT_EQ(x[i], trial.cloth.start[i]);
      ++pinned;
    }
  EXPECT_EQ(pinned, 2);
}

TEST_P(TwoIntegrators, MovingHandleFollowsItsKeyframes) {
  Scene scene = test::hanging_square();
  scene.integrator = value_named<Integrator>(GetParam());
  scene.pin[0].motion.keys = {{0, {0, 0, 0}, 0}, {0.02, {0.01, 0, 0.02}, 10}, {0.05, {0.02, 0.01, 0}, -20}};
  scene.pin[0].motion.axis = {0, 1, 1};
  scene.pin[0].motion.center = {0.05, 0.1, 0};
  const Trial trial(scene);
  const auto simulation = trial.simulation();
  double moved = 0;
  for (int frame = 0; frame < 6; ++frame) {
    simulation->advance(10);
    const auto x = simulation->positions();
    const Placement expected = placement(scene.pin[0].motion, simulation->time());
    for (std::size_t i = 0; i < x.size(); ++i) {
      if (trial.cloth.pin[i] != 0) continue;
      EXPECT_LT((x[i] - expected(trial.cloth.start[i])).norm(), 10 * kMotionRounding) << simulation->time();
      moved = std::max(moved, (x[i] - trial.cloth.start[i]).norm());
    }
  }
  EXPECT_GT(moved, 0.02);
}

TEST_P(TwoIntegrators, ReleasedPinLetsItsVertexFallFromThenOn) {
  Scene scene = test::hanging_square();
  scene.integrator = value_named<Integrator>(GetParam());
  for (Pin& pin : scene.pin) pin.until = 0.02;
  const Trial trial(scene);
  const auto simulation = trial.after(20);
  const int corner = static_cast<int>(std::find(trial.cloth.pin.begin(), trial.cloth.pin.end(), 0) -
                                      trial.cloth.pin.begin());
  EXPECT_EQ(simulation->positions()[corner], trial.cloth.start[corner]);
  simulation->advance(30);
  EXPECT_LT(simulation->positions()[corner].z(), trial.cloth.start[corner].z() - 1e-3);
}

}  // namespace
}  // namespace hysteron
