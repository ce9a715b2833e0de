// A simulation that is saved and loaded into another one goes on bit for bit.
#include <gtest/gtest.h>

#include "sim/bending/laws/law_parameters.h"
#include "tests/sim/base/refusal.h"
#include "tests/sim/contact/two_sheets.h"

namespace hysteron {
namespace {

using test::Trial;

struct Saved {
  const char* name;
  const char* integrator;
  const char* law = "prandtl";
  const char* element = "shape";
  Precision precision = Precision::fp64;
  double tolerance = 0;  // of adaptive steps [m]
  bool layers = false;   // two sheets, the upper one falls onto the lower one and slides
  bool chapter = false;  // implicit-every = step
  LawParameters param = {};
  double strength = 0;    // of the second pin [N]
  bool blocked = false;   // two layers: a rigid pin leads the upper one through the lower
  bool parts = false;     // stops along warp and weft, branches and set
  bool in_plane = false;  // stops of the membrane
  Precision linear_precision = Precision::fp64;
};

const LawParameters kFatigue = {{"fatigue.dc", "0.01"}};

const Saved kCases[] = {
    {"semi_implicit", "semi-implicit"},
    {"semi_implicit_fp32", "semi-implicit", "prandtl", "hinge", Precision::fp32},
    {"semi_implicit_adaptive", "semi-implicit", "prandtl", "shape", Precision::fp64, 1e-6},
    {"semi_implicit_chapter", "semi-implicit", "bilinear", "hinge", Precision::fp64, 0, false, true},
    {"semi_implicit_layers", "semi-implicit", "prandtl", "shape", Precision::fp64, 0, true},
    {"explicit", "explicit"},
    {"explicit_fp32", "explicit", "wong", "shape", Precision::fp32},
    {"implicit", "implicit"},
    {"implicit_fatigue", "implicit", "prandtl", "shape", Precision::fp64, 0, false, false, kFatigue},
    {"implicit_fp32", "implicit", "dahl", "shape", Precision::fp32},
    {"implicit_layers", "implicit", "prandtl", "shape", Precision::fp64, 0, true},
    {"implicit_layers_fp32", "implicit", "prandtl", "shape", Precision::fp32, 0, true},
    {"bdf2", "bdf2", "gong"},
    {"bdf2_adaptive", "bdf2", "prandtl", "hinge", Precision::fp64, 1e-5},
    {"bdf2_fp32", "bdf2", "prandtl", "shape", Precision::fp32},
    {"tr_bdf2", "tr-bdf2"},
    {"tr_bdf2_adaptive", "tr-bdf2", "wong", "shape", Precision::fp64, 1e-5, false, false, kFatigue},
    {"tr_bdf2_layers", "tr-bdf2", "prandtl", "shape", Precision::fp64, 0, true},
    {"tr_bdf2_fp32", "tr-bdf2", "kim", "shape", Precision::fp32},
    {"tr_bdf2_weak_hand", "tr-bdf2", "prandtl", "shape", Precision::fp64, 0, false, false, {}, 1e-3},
    {.name = "tr_bdf2_in_float",
     .integrator = "tr-bdf2",
     .law = "chapman",
     .parts = true,
     .linear_precision = Precision::fp32},
    {.name = "implicit_layers_in_float",
     .integrator = "implicit",
     .layers = true,
     .linear_precision = Precision::fp32},
    {"tr_bdf2_barred_hand", "tr-bdf2", "prandtl", "shape", Precision::fp64, 0, true, false, {}, 0, true},
    {"quasi_static", "quasi-static"},
    {.name = "semi_implicit_parts", .integrator = "semi-implicit", .law = "chapman", .parts = true},
    {.name = "tr_bdf2_parts_fp32",
     .integrator = "tr-bdf2",
     .law = "chapman",
     .precision = Precision::fp32,
     .parts = true},
    {.name = "tr_bdf2_parts_hinge",
     .integrator = "tr-bdf2",
     .law = "chapman",
     .element = "hinge",
     .parts = true},
    {.name = "semi_implicit_in_plane", .integrator = "semi-implicit", .in_plane = true},
    {.name = "semi_implicit_layers_in_plane",
     .integrator = "semi-implicit",
     .layers = true,
     .in_plane = true},
    {.name = "explicit_in_plane", .integrator = "explicit", .in_plane = true},
    {.name = "tr_bdf2_in_plane_fp32",
     .integrator = "tr-bdf2",
     .precision = Precision::fp32,
     .in_plane = true},
};

// The cloth is between pins that move, one of which comes later, over a ball with friction that comes up,
// with a command and viscosity on top.
Scene over_a_ball() {
  Scene scene = test::free_square(80);
  scene.cloth.length = 0.1;
  scene.solver_tolerance = 1e-4;
  scene.fabric.damping = 1e-4;
  scene.air_drag = 0.1;
  scene.step = 1.0 / 240;
  scene.pin = {test::pin_at(0, 0.1), test::pin_at(0.1, 0.1)};
  scene.pin[0].motion.keys = {{0}, {0.2, {0.02, -0.01, 0.01}, 0.3}};
  scene.pin[1].from = 0.03;
  scene.pin[1].motion.keys = {{0}, {0.2, {0, 0.01, 0}, 0}};
  scene.obstacle = {test::sphere_at({0.05, 0.05, -0.032}, 0.03)};
  scene.obstacle[0].friction = 0.4;
  scene.obstacle[0].motion.keys = {{0}, {0.2, {0.01, 0, 0.01}, 0}};
  scene.command = {{.time = 0.02, .low = {0, 0, -1}, .high = {0.05, 0.1, 1}}};
  return scene;
}

Trial saved_trial(const Saved& of) {
  Trial trial = of.layers ? test::two_sheets(Fabric{}.thickness * 1.2, 60) : Trial(over_a_ball());
  Scene& scene = trial.scene;
  scene.integrator = value_named<Integrator>(of.integrator);
  scene.law = of.law;
  scene.param = of.param;
  scene.element = value_named<BendingElement>(of.element);
  scene.precision = of.precision;
  scene.linear_precision = of.linear_precision;
  scene.tolerance = of.tolerance;
  if (of.layers) scene.gravity = {4, 1, -9};
  if (of.blocked) {
    Pin moving_pin;
    moving_pin.motion.keys = {{0}, {4 * scene.step, {0, 0, -2e-3}, 0}};
    test::hold_upper(trial, moving_pin, test::kUpperSide / 2);
  }
  if (of.parts) scene.fabric.bending = test::all_parts();
  if (of.in_plane) scene.fabric.in_plane = test::in_plane_stops();
  if (of.strength > 0) scene.pin[1].strength = of.strength;
  if (of.chapter) scene.implicit_every = ImplicitEvery::step;
  if (of.integrator == std::string("quasi-static")) scene.ramp = 0.05;
  return trial;
}

class SavedState : public testing::TestWithParam<Saved> {};
INSTANTIATE_TEST_SUITE_P(Cases, SavedState, testing::ValuesIn(kCases), test::CaseName());

// Bytes of the ledger, the counts and all measurements, which outlive a step as well.
void expect_same(Simulation& a, Simulation& b) {
  EXPECT_EQ(a.state_hash(), b.state_hash());
  EXPECT_EQ(a.ledger().rows(), b.ledger().rows());
  EXPECT_EQ(a.moment(), b.moment());
  EXPECT_EQ(a.residual_curvature(), b.residual_curvature());
  EXPECT_EQ(a.pin_forces(), b.pin_forces());
  EXPECT_EQ(a.steps(), b.steps());
  EXPECT_EQ(a.counts().linear, b.counts().linear);
  EXPECT_EQ(a.counts().newton, b.counts().newton);
  EXPECT_EQ(a.counts().parts, b.counts().parts);
  EXPECT_EQ(a.counts().saturated_pins, b.counts().saturated_pins);
  EXPECT_EQ(a.counts().blocked_pins, b.counts().blocked_pins);
  EXPECT_EQ(a.counts().pin_lag, b.counts().pin_lag);
}

TEST_P(SavedState, GoesOnBitForBit) {
  const Trial trial = saved_trial(GetParam());
  const auto first = trial.simulation();
  for (const int steps : {5, 4}) {  // the second time with the pin that comes later, and the command
    first->advance(steps);
    const std::string state = first->save();
    const auto second = trial.simulation();
    ASSERT_NE(second->state_hash(), first->state_hash());
    second->load(state);
    expect_same(*first, *second);
    first->advance(1);
    second->advance(1);
    expect_same(*first, *second);
    first->advance(6);
    second->advance(6);
    expect_same(*first, *second);
  }
}

// Taking the state down is a measurement.
TEST_P(SavedState, IsNotChangedBySaving) {
  const Trial trial = saved_trial(GetParam());
  const auto first = trial.simulation(), second = trial.simulation();
  for (int k = 0; k < 4; ++k) {
    first->advance(2);
    second->advance(2);
    second->save();
  }
  expect_same(*first, *second);
}

TEST(SavedState, CutOffOrTooLongIsRefused) {
  const Trial trial = saved_trial(kCases[0]);
  const std::string state = trial.after(1)->save();
  for (const std::string& wrong : {state + "x", state.substr(0, state.size() / 2), std::string()}) {
    const auto simulation = trial.simulation();
    EXPECT_NE(test::refusal([&] { simulation->load(wrong); }), test::kAccepted);
  }
}

}  // namespace
}  // namespace hysteron
