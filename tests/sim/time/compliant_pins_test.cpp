// Pins of limited strength are checked: their forces, where they let the cloth lag, and that nothing tears.
#include <gtest/gtest.h>

#include <random>

#include "sim/mesh/intersections.h"
#include "sim/scene/scene_reader.h"
#include "sim/time/compliant_pins.h"
#include "tests/sim/base/refusal.h"
#include "tests/sim/contact/two_sheets.h"

namespace hysteron {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using test::Trial;

constexpr double kYieldFractionOfThickness = 0.5;

// The pin of one vertex pulls with 2 N beyond 0.1 mm.
struct OneCompliantPin {
  Vector3d target{1e-3, 2e-3, 3e-3};
  double strength = 2;
  CompliantPins<double> compliant_pins{&target, &strength, 1e-4};
};

TEST(CompliantPin, PullsByTheDerivativeOfItsEnergyToSecondOrder) {
  const OneCompliantPin one;
  const Vector3d d = Vector3d(0.3, -0.5, 0.8).normalized();
  for (double lag : {0.4e-4, 5e-4}) {
    const Vector3d x = one.target + lag * Vector3d(0.6, 0, 0.8);
    const auto error = [&](double h) {
      const double rise = one.compliant_pins.energy(0, x + h * d) - one.compliant_pins.energy(0, x - h * d);
      return std::abs(rise / (2 * h) + one.compliant_pins.force(0, x).dot(d));
    };
    if (lag > one.compliant_pins.yield_distance)
      EXPECT_GT(std::log(error(4e-5) / error(1e-5)) / std::log(4), 1.8);
    else
      EXPECT_LT(error(1e-5), 1e-12);  // a parabola
  }
}

TEST(CompliantPin, LosesAShareOfItsStiffnessAlongTheWay) {
  const OneCompliantPin one;
  const Vector3d n(0.6, 0, 0.8), x = one.target + 5e-4 * n;
  const Matrix3d far = one.compliant_pins.stiffness(0, x, 0), near = one.compliant_pins.stiffness(0, x, 0.75);
  const Vector3d across(0, 1, 0);
  const double h = 1e-8;  // across the way both are the derivative of the force
  const Vector3d change =
      (one.compliant_pins.force(0, x - h * across) - one.compliant_pins.force(0, x + h * across)) / (2 * h);
  EXPECT_NEAR((far * across - change).norm(), 0, 1e-6 * change.norm());
  EXPECT_NEAR((near * across - change).norm(), 0, 1e-6 * change.norm());
  EXPECT_NEAR(n.dot(near * n), 0.25 * n.dot(far * n), 1e-12 * n.dot(far * n));
}

TEST(CompliantPin, LiesBelowTheParabolaOfItsStiffness) {
  const OneCompliantPin one;
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  const auto draw = [&] { return Vector3d(normal(random), normal(random), normal(random)); };
  for (int k = 0; k < 1000; ++k) {
    const Vector3d x = one.target + 3e-4 * draw(), d = 5e-4 * draw();
    const double bound = one.compliant_pins.energy(0, x) - one.compliant_pins.force(0, x).dot(d) +
                         d.dot(one.compliant_pins.stiffness(0, x, 0) * d) / 2;
    EXPECT_LE(one.compliant_pins.energy(0, x + d), bound + 1e-15);
  }
}

// Returns a square that hangs by two corners, each held with this strength [N].
Trial hanging_by(double strength) {
  Scene scene = test::hanging_square(100);
  scene.gravity = {0, -9.81, 0};
  scene.integrator = Integrator::implicit;
  scene.step = 1.0 / 240;
  for (Pin& pin : scene.pin) pin.strength = strength;
  return Trial(scene);
}

double cloth_weight(const Trial& trial) {
  double sum = 0;
  for (int i = 0; i < trial.cloth.mesh.vertices(); ++i) sum += trial.mass(i) * trial.scene.gravity.norm();
  return sum;
}

Vector3d force_sum(const std::vector<Vector3d>& forces) {
  Vector3d sum = Vector3d::Zero();
  for (const Vector3d& f : forces) sum += f;
  return sum;
}

TEST(PinsOfLimitedStrength, GiveInProportionToWhatTheyCarry) {
  const double kStrength = 2;
  const Trial trial = hanging_by(kStrength);
  const auto simulation = trial.simulation();
  simulation->become_static();
  simulation->advance(60);
  EXPECT_NEAR(force_sum(simulation->pin_forces()).y(), cloth_weight(trial), 1e-5 * cloth_weight(trial));
  const auto x = simulation->positions();
  const auto force = simulation->pin_forces();
  int pins = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (force[i].isZero(0)) continue;
    ++pins;
    const double yield_distance =
        kYieldFractionOfThickness * trial.scene.fabric.thickness * force[i].norm() / kStrength;
    EXPECT_NEAR((x[i] - trial.cloth.start[i]).norm(), yield_distance, 1e-9);
  }
  EXPECT_EQ(pins, 2);
  EXPECT_EQ(simulation->counts().saturated_pins, 0);
}

// The cloth falls freely under the weight that the pins do not carry.
TEST(PinsOfLimitedStrength, LetGoOfWhatIsTooHeavyButPullOn) {
  Trial trial = hanging_by(1);
  const double weight = cloth_weight(trial), kFraction = 0.6;
  for (Pin& pin : trial.scene.pin) pin.strength = kFraction * weight / 2;
  const auto simulation = trial.simulation();
  const auto middle = [&] {
    Vector3d sum = Vector3d::Zero();
    const auto x = simulation->positions();
    for (std::size_t i = 0; i < x.size(); ++i) sum += trial.mass(static_cast<int>(i)) * x[i];
    return sum.y() * trial.scene.gravity.norm() / weight;
  };
  constexpr int kBefore = 60, kSteps = 24;
  simulation->advance(kBefore);
  const double first = middle();
  simulation->advance(kSteps);
  const double second = middle();
  simulation->advance(kSteps);
  const double third = middle();
  const double t = kSteps * trial.scene.step, g = trial.scene.gravity.norm();
  EXPECT_NEAR((third - 2 * second + first) / (t * t), -(1 - kFraction) * g, 0.02 * g);
  EXPECT_GT(simulation->counts().saturated_pins, kSteps);
  EXPECT_GT(simulation->counts().pin_lag, 0.05);
  for (const Vector3d& f : simulation->pin_forces())
    EXPECT_LE(f.norm(), kFraction * weight / 2 * (1 + 1e-12));
}

TEST(PinsOfLimitedStrength, DoWorkThatTheBalanceCloses) {
  for (Integrator integrator : {Integrator::implicit, Integrator::bdf2, Integrator::tr_bdf2}) {
    Trial trial = hanging_by(1);
    trial.scene.integrator = integrator;
    trial.scene.law = "prandtl";
    trial.scene.newton_residual = 1e-9;
    trial.scene.pin[0].strength = 0.3 * cloth_weight(trial);
    trial.scene.pin[1].motion.keys = {{0, {0, 0, 0}, 0}, {0.2, {0, 0.05, 0}, 0}};
    const auto simulation = trial.after(60);
    const Ledger ledger = simulation->ledger();
    EXPECT_GT(std::abs(ledger.pin_work), 1e-3 * cloth_weight(trial) * 0.05);
    EXPECT_LT(std::abs(ledger.remainder_relative), 1e-9) << enum_name(integrator);
  }
}

// A rigid pin gives way here (blocked_pins_test.cpp).
TEST(PinsOfLimitedStrength, ThatPushTheClothThroughItselfLagBehind) {
  constexpr double kGap = 5e-3, kTravel = 1e-2, kTime = 0.1, kStrength = 0.5;  // [m], [s], [N]
  Trial trial = test::two_sheets(kGap, 60);
  const Motion down{{{0}, {kTime, {0, 0, -kTravel}}}};
  test::hold_upper(trial, {.strength = kStrength, .motion = down}, 0.7 * test::kUpperSide);
  const auto simulation = trial.at(1.5 * kTime);
  EXPECT_EQ(simulation->counts().unbalanced, 0);
  EXPECT_GT(simulation->counts().saturated_pins, 0);
  EXPECT_GT(simulation->counts().pin_lag, kTravel - kGap);
  const std::vector<Vector3d> force = simulation->pin_forces();
  Vector3d pull = Vector3d::Zero();
  for (int i : trial.cloth.pin_vertices[1]) pull += force[i];
  EXPECT_LT(pull.z(), -0.1 * kStrength);
  EXPECT_LE(pull.norm(), kStrength * (1 + 1e-12));
  EXPECT_TRUE(intersecting_triangles(trial.cloth.mesh.face, simulation->positions()).empty());
}

// The pins of two sheets are told to swap places: the stronger one gets where it wants.
TEST(PinsOfLimitedStrength, AgainstEachOtherDoNotTear) {
  constexpr double kGap = 4e-3, kTime = 0.1;
  Trial trial = test::two_sheets(kGap, 60);
  const int vertices = trial.cloth.mesh.vertices();
  const int lower = static_cast<int>(trial.cloth.pin_vertices[0].size());
  trial.scene.pin[0].motion.keys = {{0, {0, 0, 0}, 0}, {kTime, {0, 0, kGap}, 0}};
  trial.scene.pin[0].strength = 4;
  const Motion down{{{0}, {kTime, {0, 0, -kGap}}}};
  test::hold_upper(trial, {.strength = 1, .motion = down}, 1);  // all of it
  const auto simulation = trial.at(1.5 * kTime);
  const auto x = simulation->positions();
  EXPECT_TRUE(intersecting_triangles(trial.cloth.mesh.face, x).empty());
  const double yield_distance = kYieldFractionOfThickness * trial.scene.fabric.thickness;
  double below = 0, above = 0;
  for (int i = 0; i < vertices; ++i)
    (i < lower ? below : above) += x[i].z() / (i < lower ? lower : vertices - lower);
  EXPECT_NEAR(below, kGap, yield_distance);
  EXPECT_GT(above, kGap);
  EXPECT_EQ(simulation->counts().unbalanced, 0);
}

TEST(PinsOfLimitedStrength, NeedAnIntegratorThatIsImplicitInAllForces) {
  Scene scene = test::hanging_square(100);
  scene.pin[0].strength = 1;
  for (Integrator integrator : {Integrator::semi_implicit, Integrator::explicit_euler}) {
    scene.integrator = integrator;
    EXPECT_TRUE(test::says(test::refusal([&] { check_scene(scene); }), "pin[0].strength = 1 N"));
  }
}

}  // namespace
}  // namespace hysteron
