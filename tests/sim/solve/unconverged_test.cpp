// Steps that are taken before Newton's method has converged, and hands that bring cloth home.
#include <gtest/gtest.h>

#include "tests/sim/solve/scenes.h"

namespace hysteron {
namespace {

using test::Trial;

constexpr double kRounding = 1e-10;

Scene capped(int iterations) {
  Scene scene = test::hanging_square();
  scene.integrator = "implicit";
  scene.step = 1.0 / 60;
  scene.newton_iterations = iterations;
  return scene;
}

// What the solve leaves unbalanced is a term of its own, so that the ledger closes nevertheless.
TEST(UnconvergedSteps, CloseTheLedger) {
  Trial one(capped(1));
  test::ripple(one.cloth, 3e-3);
  const auto simulation = one.after(20);
  const Ledger ledger = simulation->ledger();
  EXPECT_EQ(simulation->unbalanced_steps(), 20);
  EXPECT_EQ(simulation->retried_steps(), 0);
  EXPECT_GT(std::abs(ledger.unbalanced), 1e-9);
  EXPECT_LT(ledger.remainder_relative, kRounding);
}

TEST(UnconvergedSteps, AreNoneWhereTheLimitIsNotReached) {
  Trial many(capped(1000)), free(capped(0));
  const auto limited = many.after(5), full = free.after(5);
  EXPECT_EQ(limited->unbalanced_steps(), 0);
  EXPECT_EQ(limited->state_hash(), full->state_hash());
  EXPECT_LT(std::abs(full->ledger().unbalanced), 1e-6 * std::abs(full->ledger().gravitational));
}

// Taken late and far from where it was, a corner is back after the pin's time for that, and the hand's work
// is booked.
TEST(HandsThatBringHome, AreThereInTime) {
  Scene scene = test::hanging_square();
  scene.integrator = "implicit";
  scene.step = 1.0 / 120;
  scene.seconds = 1;
  scene.air_drag = 1;
  Pin pin;
  pin.select = "nearest";
  pin.point = {scene.cloth.length, 0, 0};
  pin.from = 0.1;
  pin.home = 0.2;
  scene.pin.push_back(pin);
  const Trial trial(scene);
  const int corner = trial.cloth.grip.back()[0];
  const auto simulation = trial.after(12);
  EXPECT_GT((simulation->positions()[corner] - trial.cloth.start[corner]).norm(), 1e-2);
  simulation->advance(24);
  EXPECT_LT((simulation->positions()[corner] - trial.cloth.start[corner]).norm(), kRounding);
  const Ledger ledger = simulation->ledger();
  EXPECT_GT(ledger.handle_work, 0);
  EXPECT_LT(ledger.remainder_relative, 1e-6);
}

}  // namespace
}  // namespace hysteron
