// The search for rest: what it finds, and what it leaves where there is none.
#include "experiments/workbench/session/resting.h"

#include <gtest/gtest.h>

#include "tests/sim/time/scenes.h"

namespace hysteron::experiments {
namespace {

using test::Trial;

Scene hanging_in_motion() {
  Scene scene = test::hanging_square(60);
  scene.integrator = Integrator::tr_bdf2;
  scene.law = "prandtl";
  scene.step = 1.0 / 120;
  return scene;
}

TEST(SeekRest, EndsWhereAnotherStepWithoutInertiaMovesNothing) {
  const Trial trial(hanging_in_motion());
  const auto simulation = trial.after(10);
  const Rest rest = seek_rest(*simulation, trial.scene.fabric.thickness);
  EXPECT_EQ(rest.failure, "");
  const double still = 0.01 * trial.scene.fabric.thickness;
  EXPECT_LE(rest.moved, still);
  const test::Positions found = simulation->positions();
  EXPECT_GT(test::farthest(found, trial.after(10)->positions()), still) << "it was in motion";
  simulation->advance(1);
  EXPECT_LE(test::farthest(found, simulation->positions()), still);
}

// Nothing holds it: its weight alone has no equilibrium, wherever Newton's method ends.
TEST(SeekRest, LeavesFallingClothInTheStateOfItsMotion) {
  Scene scene = hanging_in_motion();
  scene.pin.clear();
  const Trial trial(scene);
  const auto simulation = trial.after(10), left_alone = trial.after(10);
  const Rest rest = seek_rest(*simulation, scene.fabric.thickness);
  EXPECT_NE(rest.failure, "");
  EXPECT_EQ(simulation->state_hash(), left_alone->state_hash());
  EXPECT_EQ(simulation->steps(), 10);
  EXPECT_EQ(simulation->counts().unbalanced, 0);
  const auto rows = simulation->ledger().rows(), expected = left_alone->ledger().rows();
  for (std::size_t k = 0; k < rows.size(); ++k) EXPECT_EQ(rows[k], expected[k]) << rows[k].first;
  EXPECT_EQ(simulation->moment(), left_alone->moment());
}

}  // namespace
}  // namespace hysteron::experiments
