// Newton's method in double precision whose linear systems are solved in single precision.
#include <gtest/gtest.h>

#include "tests/sim/contact/two_sheets.h"

namespace hysteron {
namespace {

using test::Positions;
using test::Trial;

struct End {
  Positions positions;
  Diagnostics counts;
};

struct Case {
  const char* name;
  Trial (*trial)();
  int steps;
};

// A square that drapes over a ball with friction: of a stiff cloth, since a limp one buckles, each way to do
// so is a minimum, and rounding chooses.
Trial drape() {
  Scene scene = test::free_square(200);
  scene.law = "prandtl";
  scene.fabric.b1 *= 100;
  scene.fabric.b2 *= 100;
  scene.step = 1.0 / 120;
  scene.integrator = Integrator::tr_bdf2;
  scene.obstacle = {test::sphere_at({0.1, 0.1, -0.0605}, 0.06)};
  scene.obstacle[0].friction = 0.3;
  return Trial(scene);
}

// A strip whose one end is turned over by more than a right angle, and let go.
Trial crease() {
  Scene scene = test::free_square(240);
  scene.cloth.shape = ClothOutline::strip;
  scene.cloth.length = 0.06;
  scene.cloth.width = 0.02;
  scene.law = "prandtl";
  scene.step = 1.0 / 120;
  scene.integrator = Integrator::tr_bdf2;
  const Pin still = test::pin_in({-1, -1, -1}, {0.0201, 1, 1});
  Pin turns = test::pin_in({0.0399, -1, -1}, {1, 1, 1});
  turns.until = 0.1;
  turns.motion.axis = {0, -1, 0};
  turns.motion.center = {0.03, 0, 0};
  turns.motion.keys = {{0}, {0.1, {0, 0, 0}, 120}};
  scene.pin = {still, turns};
  return Trial(scene);
}

// Returns two sheets of which the upper one slides.
Trial layers() {
  Trial trial = test::two_sheets(Fabric{}.thickness * 1.2, 100);
  trial.scene.gravity = {6, 1, -9};
  return trial;
}

class FloatSolves : public testing::TestWithParam<Case> {
 protected:
  static End end(double residual, Precision linear) {
    Trial trial = GetParam().trial();
    trial.scene.linear_solver = Preconditioning::multigrid;
    trial.scene.linear_precision = linear;
    trial.scene.newton_residual = residual;
    trial.scene.newton_velocity = 0;
    const auto simulation = trial.after(GetParam().steps);
    EXPECT_GT(test::farthest(simulation->positions(), trial.cloth.start), 1e-3) << "nothing moved";
    return {simulation->positions(), simulation->counts()};
  }
};
INSTANTIATE_TEST_SUITE_P(Scenes, FloatSolves,
                         testing::Values(Case{"drape", drape, 12}, Case{"crease", crease, 16},
                                         Case{"layers", layers, 16}),
                         test::CaseName());

// Where a step ends is decided in double: what it leaves unbalanced is what the scene allows, and its
// positions are nearer to the exact ones than those of a looser tolerance.
TEST_P(FloatSolves, EndWithTheSameNewtonResidualAndWithinItsError) {
  constexpr double kUsual = 1e-6, kLoose = 1e-4, kExact = 1e-9;
  const End exact = end(kExact, Precision::fp64), loose = end(kLoose, Precision::fp64),
            usual = end(kUsual, Precision::fp64), in_float = end(kUsual, Precision::fp32);
  EXPECT_LE(in_float.counts.largest_residual, kUsual);
  EXPECT_EQ(in_float.counts.retried, usual.counts.retried);
  EXPECT_LE(in_float.counts.newton, 1.1 * static_cast<double>(usual.counts.newton));
  EXPECT_NE(test::farthest(in_float.positions, usual.positions), 0) << "solved in double";
  EXPECT_LT(test::farthest(in_float.positions, exact.positions),
            test::farthest(loose.positions, exact.positions));
}

TEST_P(FloatSolves, ReachWhatOnlyDoubleResolves) {
  constexpr double kFine = 1e-9;
  EXPECT_LE(end(kFine, Precision::fp32).counts.largest_residual, kFine);
}

}  // namespace
}  // namespace hysteron
