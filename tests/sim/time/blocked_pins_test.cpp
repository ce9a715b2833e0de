// Cloth bars the way of rigid pins: the pinned vertices go as far as they can, and nothing tears.
#include <gtest/gtest.h>

#include "sim/mesh/intersections.h"
#include "tests/sim/contact/two_sheets.h"

namespace hysteron {
namespace {

using Eigen::Vector3d;
using test::Trial;

constexpr double kRounding = 1e-15;                          // of positions [m]
constexpr double kGap = 3e-3, kTravel = 6e-3, kTime = 0.05;  // of the sheets, down and in [m], [s]

bool crosses(const Trial& trial, Simulation& simulation) {
  return !intersecting_triangles(trial.cloth.mesh.face, simulation.positions()).empty();
}

// The upper sheet, all of it or its part up to `most_x` [m], is led through the lower one, which is held, and
// back.
Trial led_through(double most_x, Integrator integrator = Integrator::implicit) {
  Trial trial = test::two_sheets(kGap, 60);
  trial.scene.integrator = integrator;
  const Motion there_and_back{{{0}, {kTime, {0, 0, -kTravel}}, {2 * kTime}}};
  test::hold_upper(trial, {.motion = there_and_back}, most_x);
  return trial;
}

constexpr double kPart = 0.7 * test::kUpperSide, kAll = 2 * test::kUpperSide;

// The lower sheet is lifted by five times the gap in one step.  The upper one presses on it with its inertia
// alone, a hair of what the pin may pull with.
TEST(BlockedPins, PushAFreeSheetByMoreThanTheGapInOneStep) {
  const double thickness = Fabric{}.thickness, gap = 1.1 * thickness, lift = 5 * gap;
  for (Integrator integrator : {Integrator::implicit, Integrator::bdf2, Integrator::tr_bdf2}) {
    Trial trial = test::two_sheets(gap, 60);
    trial.scene.integrator = integrator;
    trial.scene.pin[0].motion.keys = {{0, {0, 0, 0}, 0}, {trial.scene.step, {0, 0, lift}, 0}};
    const auto simulation = trial.after(1);
    EXPECT_GT(simulation->counts().blocked_pins, 0);
    EXPECT_EQ(simulation->counts().retried, 0);
    EXPECT_EQ(simulation->counts().saturated_pins, 0);
    EXPECT_FALSE(crosses(trial, *simulation));
    // Give is in proportion to the pressure: mass per area times the lift over the square of half a step.
    const double pressure = trial.scene.fabric.density * lift / std::pow(trial.scene.step / 2, 2);
    const double yield_distance = thickness / 2 * pressure / (10 * 4903);
    EXPECT_GT(simulation->counts().pin_lag, 0);
    EXPECT_LT(simulation->counts().pin_lag, 10 * yield_distance) << enum_name(integrator);
    simulation->advance(1);
    const auto x = simulation->positions();
    for (int i : trial.cloth.pin_vertices[0])
      EXPECT_NEAR((x[i] - trial.cloth.start[i] - Vector3d(0, 0, lift)).norm(), 0, kRounding);
  }
}

// Held layers are in no pair of self-contact; led through each other, they are stopped all the same.
TEST(BlockedPins, OfTwoRigidHandsLeadNothingThroughEachOtherAndReturn) {
  for (double most_x : {kPart, kAll}) {
    const Trial trial = led_through(most_x);
    const auto simulation = trial.simulation();
    for (int k = 0; k < 2; ++k) {
      simulation->advance(trial.steps(kTime / 2));
      EXPECT_FALSE(crosses(trial, *simulation)) << k;
    }
    EXPECT_GT(simulation->counts().blocked_pins, 0);
    EXPECT_GT(simulation->counts().saturated_pins, 0);
    EXPECT_EQ(simulation->counts().unbalanced, 0);
    EXPECT_NEAR(simulation->counts().pin_lag, kTravel - kGap, Fabric{}.thickness);
    simulation->advance(trial.steps(1.2 * kTime));
    for (const auto& vertices : trial.cloth.pin_vertices)
      for (int i : vertices)
        EXPECT_NEAR((simulation->positions()[i] - trial.cloth.start[i]).norm(), 0, kRounding);
  }
}

// A place that no step can reach is not written as its end.
TEST(BlockedPins, AreNotPutWhereTheyCouldNotGo) {
  const Trial trial = led_through(kAll);
  const auto simulation = trial.at(kTime);
  double lowest = kGap, highest = 0;
  const auto x = simulation->positions();
  for (int i : trial.cloth.pin_vertices[1]) lowest = std::min(lowest, x[i].z());
  for (int i : trial.cloth.pin_vertices[0]) highest = std::max(highest, x[i].z());
  EXPECT_EQ(highest, 0);
  EXPECT_GT(lowest, 0.1 * Fabric{}.thickness);
}

// Pressed by no more than ten times the pressure of the compression test, on both sheets alike.
TEST(BlockedPins, PressWithTheirPressureOnTheAreaOfWhatTheyHold) {
  const Trial trial = led_through(kAll);
  const auto simulation = trial.at(kTime);
  const auto force = simulation->pin_forces();
  Vector3d sum = Vector3d::Zero();
  double area = 0;
  for (int i : trial.cloth.pin_vertices[1]) {
    sum += force[i];
    area += trial.cloth.mesh.vertex_area[i];
  }
  constexpr double kOfWeight = 1e-2;
  EXPECT_NEAR(sum.z(), -10 * 4903.325 * area, kOfWeight * 10 * 4903.325 * area);
}

TEST(BlockedPins, DoWorkThatTheBalanceCloses) {
  for (Integrator integrator : {Integrator::implicit, Integrator::bdf2, Integrator::tr_bdf2}) {
    Trial trial = led_through(kPart, integrator);
    trial.scene.newton_residual = 1e-9;
    const auto simulation = trial.at(2.2 * kTime);
    EXPECT_GT(simulation->counts().blocked_pins, 0);
    EXPECT_LT(std::abs(simulation->ledger().remainder_relative), 1e-9) << enum_name(integrator);
  }
}

TEST(BlockedPins, AreRigidWhereNothingIsInTheirWay) {
  Trial trial = led_through(kPart);
  trial.scene.pin[1].motion.keys[1].position.z() = 3 * kTravel;  // up
  const auto simulation = trial.at(kTime);
  EXPECT_EQ(simulation->counts().blocked_pins, 0);
  EXPECT_EQ(simulation->counts().pin_lag, 0);
}

TEST(BlockedPins, GiveWayInSemiImplicitStepsAndInSinglePrecisionToo) {
  for (const bool single : {false, true}) {
    Trial trial = led_through(kPart, single ? Integrator::implicit : Integrator::semi_implicit);
    if (single) trial.scene.precision = Precision::fp32;
    const auto simulation = trial.at(kTime);
    EXPECT_GT(simulation->counts().blocked_pins, 0);
    EXPECT_FALSE(crosses(trial, *simulation));
  }
}

}  // namespace
}  // namespace hysteron
