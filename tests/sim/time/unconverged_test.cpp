// These tests take steps before Newton's method has converged, and let pins bring cloth home.
#include <gtest/gtest.h>

#include "tests/sim/time/scenes.h"

namespace hysteron {
namespace {

using test::Trial;

constexpr double kUnconvergedRounding = 1e-10;

Scene capped(int iterations) {
  Scene scene = test::hanging_square();
  scene.integrator = Integrator::implicit;
  scene.step = 1.0 / 60;
  scene.newton_iterations = iterations;
  return scene;
}

// The unbalanced remainder of a solve is a term of its own, so that the ledger closes nevertheless.
TEST(UnconvergedSteps, CloseTheLedger) {
  const Trial one = test::rippled(capped(1), 3e-3);
  const auto simulation = one.after(20);
  const Ledger ledger = simulation->ledger();
  EXPECT_EQ(simulation->counts().unbalanced, 20);
  EXPECT_EQ(simulation->counts().retried, 0);
  EXPECT_GT(std::abs(ledger.unbalanced), 1e-9);
  EXPECT_LT(ledger.remainder_relative, kUnconvergedRounding);
}

TEST(UnconvergedSteps, AreNoneWhereTheLimitIsNotReached) {
  Trial many(capped(1000)), free(capped(0));
  const auto limited = many.after(5), full = free.after(5);
  EXPECT_EQ(limited->counts().unbalanced, 0);
  EXPECT_EQ(limited->state_hash(), full->state_hash());
  EXPECT_LT(std::abs(full->ledger().unbalanced), 1e-6 * std::abs(full->ledger().gravitational));
}

// Cloth that falls freely has no equilibrium: the search for one ends, and says so by counting.
TEST(UnconvergedSteps, AreWhatASearchForRestTakesWhereThereIsNone) {
  Scene scene = test::free_square();
  scene.integrator = Integrator::bdf2;
  scene.step = 1.0 / 120;
  const auto simulation = Trial(scene).after(5);
  EXPECT_EQ(simulation->counts().unbalanced, 0);
  simulation->become_static();
  simulation->advance(1);
  EXPECT_EQ(simulation->counts().unbalanced, 1);
  EXPECT_EQ(simulation->counts().retried, 0);
}

// A corner that is taken late and far from where it was is back after the pin's time for that, and the pin's
// work is booked.
TEST(HandsThatBringHome, AreThereInTime) {
  Scene scene = test::hanging_square();
  scene.integrator = Integrator::implicit;
  scene.step = 1.0 / 120;
  scene.seconds = 1;
  scene.air_drag = 1;
  Pin pin = test::pin_at(scene.cloth.length, 0);
  pin.from = 0.1;
  pin.home = 0.2;
  scene.pin.push_back(pin);
  const Trial trial(scene);
  const int corner = trial.cloth.pin_vertices.back()[0];
  const auto simulation = trial.after(12);
  EXPECT_GT((simulation->positions()[corner] - trial.cloth.start[corner]).norm(), 1e-2);
  simulation->advance(24);
  EXPECT_LT((simulation->positions()[corner] - trial.cloth.start[corner]).norm(), kUnconvergedRounding);
  const Ledger ledger = simulation->ledger();
  EXPECT_GT(ledger.pin_work, 0);
  EXPECT_LT(ledger.remainder_relative, 1e-6);
}

// Only the cloth's own motion tells what is small where there are neither weight nor pins.
class FreeCloth : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Integrators, FreeCloth, testing::Values("implicit", "bdf2", "tr-bdf2"));

Scene weightless(const char* integrator) {
  Scene scene = test::free_square();
  scene.gravity.setZero();
  scene.law = "prandtl";
  scene.integrator = value_named<Integrator>(integrator);
  scene.step = 1.0 / 120;
  scene.newton_velocity = 0;
  return scene;
}

TEST_P(FreeCloth, SolvesItsStepsAndKeepsItsMomentum) {
  Trial trial(weightless(GetParam()));
  for (int i = 0; i < trial.cloth.mesh.vertices(); ++i)
    trial.cloth.start[i].z() += 5e-5 * std::sin(20 * trial.cloth.mesh.rest[i].x());
  const auto simulation = trial.after(100);
  EXPECT_EQ(simulation->counts().retried, 0);
  const test::Momenta sum = test::momenta(trial, *simulation);
  EXPECT_GT(sum.size, 0);
  EXPECT_LT(sum.linear.norm(), 1e-5 * sum.size);
}

// A pin throws the cloth as it lets go: what rounding makes of forces is all that acts then.
TEST_P(FreeCloth, DriftsSlowlyInSinglePrecision) {
  constexpr double kSpeed = 1e-4;  // [m/s]
  Scene scene = weightless(GetParam());
  scene.precision = Precision::fp32;
  Pin moving_pin = test::pin_in({-1, -1, -1}, {1, 1, 1});
  moving_pin.until = 5 * scene.step;
  moving_pin.motion.keys = {{0, {0, 0, 0}, 0, 1},
                            {2 * moving_pin.until, {0, 0, 2 * moving_pin.until * kSpeed}, 0, 1}};
  scene.pin = {moving_pin};
  const Trial trial(scene);
  auto simulation = trial.after(6);
  const double before = simulation->positions()[0].z();
  simulation->advance(50);
  EXPECT_EQ(simulation->counts().retried, 0);
  const double speed = (simulation->positions()[0].z() - before) / (50 * scene.step);
  EXPECT_GT(speed, kSpeed);
  EXPECT_LT(speed, 2 * kSpeed);
}

}  // namespace
}  // namespace hysteron
