// A program drives these pins from step to step.
#include <gtest/gtest.h>

#include <cstring>

#include "sim/scene/motion.h"
#include "tests/sim/base/refusal.h"
#include "tests/sim/time/scenes.h"

namespace hysteron {
namespace {

constexpr double kDrivenRounding = 1e-15;  // [m], of places of 0.1 m

Scene held_at_a_corner() {
  Scene scene = test::free_square(50);
  scene.step = 1.0 / 240;
  scene.pin = {test::pin_at(0, 0)};
  return scene;
}

TEST(SteadyMotion, GoesOnInAStraightLineFromWhereTheMotionWas) {
  Motion motion;
  motion.keys = {{0}, {1, {0.1, 0, 0}, 30}};
  const double now = 0.3;
  const Eigen::Vector3d velocity(0.02, -0.5, 0.1);
  const Keyframe from = state_at(motion, now);
  const Motion steady = steady_from(motion, now, velocity, 40);
  EXPECT_GT(from.position.x(), 0);
  for (const double later : {0.0, 1e-3, 0.5, 100.0}) {
    const Keyframe at = state_at(steady, now + later);
    const double scale = 1 + later;
    EXPECT_LT((at.position - from.position - later * velocity).norm(), 1e-12 * scale) << later;
    EXPECT_NEAR(at.angle, from.angle + 40 * later, 1e-10 * scale) << later;
  }
}

TEST(DrivenPin, MovesWhatItHoldsAtItsVelocityUntilItIsDrivenAgain) {
  for (const Integrator integrator : {Integrator::implicit, Integrator::semi_implicit, Integrator::tr_bdf2}) {
    Scene scene = held_at_a_corner();
    scene.integrator = integrator;
    const test::Trial trial(scene);
    const auto simulation = trial.after(2);
    const int corner = trial.cloth.pin_vertices[0][0];
    const Eigen::Vector3d start = simulation->positions()[corner], velocity(0.1, 0, -0.2);
    simulation->drive(0, velocity, 0);
    simulation->advance(5);
    simulation->drive(0, {0, 0, 0}, 0);
    simulation->advance(5);
    const Eigen::Vector3d displacement = simulation->positions()[corner] - start;
    EXPECT_LT((displacement - 5 * scene.step * velocity).norm(), kDrivenRounding) << enum_name(integrator);
    EXPECT_LT((simulation->pin_displacement(0).position - displacement).norm(), kDrivenRounding)
        << enum_name(integrator);
  }
}

TEST(DrivenPin, ThatStandsStillChangesNoBit) {
  const test::Trial trial(held_at_a_corner());
  const auto alone = trial.simulation(), driven = trial.simulation();
  driven->drive(0, {0, 0, 0}, 0);
  for (const auto& simulation : {alone.get(), driven.get()}) simulation->advance(10);
  EXPECT_EQ(driven->state_hash(), alone->state_hash());
}

TEST(DrivenPin, IsPartOfWhatIsSaved) {
  const test::Trial trial(held_at_a_corner());
  const auto first = trial.after(1), second = trial.simulation();
  first->drive(0, {0.1, 0.1, 0}, 45);
  first->advance(3);
  second->load(first->save());
  for (const auto& simulation : {first.get(), second.get()}) simulation->advance(3);
  EXPECT_EQ(second->state_hash(), first->state_hash());
}

TEST(DrivenPin, ThatThereIsNotIsRefused) {
  const test::Trial trial(held_at_a_corner());
  const auto simulation = trial.simulation();
  EXPECT_EQ(test::refusal([&] {
              simulation->drive(1, {0, 0, 0}, 0);
            }),
            "pin = 1 must be in [0, 0], a pin of the scene");
}

TEST(State, LiesWhereItIsSaidToLie) {
  const test::Trial trial(held_at_a_corner());
  const auto simulation = trial.after(3);
  const std::vector<Eigen::Vector3d> x = simulation->positions(), v = simulation->velocities();
  const double *positions = simulation->positions_in_place().fp64,
               *velocities = simulation->velocities_in_place().fp64;
  ASSERT_NE(positions, nullptr);
  EXPECT_EQ(std::memcmp(positions, x.data(), x.size() * sizeof x[0]), 0);
  EXPECT_EQ(std::memcmp(velocities, v.data(), v.size() * sizeof v[0]), 0);
  EXPECT_EQ(simulation->positions_in_place().fp32, nullptr);
}

}  // namespace
}  // namespace hysteron
