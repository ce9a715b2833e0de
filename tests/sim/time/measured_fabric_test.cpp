// Cloth whose fabric has more than three numbers: stops, relaxing branches and a set in motion.
#include <gtest/gtest.h>

#include "tests/sim/time/scenes.h"

namespace hysteron {
namespace {

using test::Method;
using test::Trial;

// A free sheet without weight that starts from waves and swings.
Trial rippled(const Method& method, const BendingParts& parts) {
  Scene scene = test::free_square(60);
  scene.law = method.law;
  scene.element = value_named<BendingElement>(method.element);
  scene.integrator = value_named<Integrator>(method.integrator);
  scene.fabric.bending = parts;
  scene.gravity.setZero();
  scene.step = 1e-3;
  Trial trial(scene);
  test::ripple(trial.cloth, 3e-2);
  return trial;
}

BendingParts along_warp() {
  BendingParts parts = test::all_parts();
  parts.weft_stops = {};
  return parts;
}

class MeasuredFabric : public testing::TestWithParam<Method> {};
INSTANTIATE_TEST_SUITE_P(
    Methods, MeasuredFabric,
    testing::Values(Method{"chapman", "shape", "semi-implicit"}, Method{"chapman", "hinge", "semi-implicit"},
                    Method{"chapman", "shape", "explicit"}, Method{"chapman", "hinge", "implicit"},
                    Method{"chapman", "shape", "bdf2"}, Method{"chapman", "shape", "tr-bdf2"},
                    Method{"prandtl", "shape", "tr-bdf2"}, Method{"prandtl", "hinge", "implicit"}),
    [](const auto& method) { return method.param.name(); });

TEST_P(MeasuredFabric, LosesEnergyToFrictionAndRelaxationInABalanceThatCloses) {
  const bool two = GetParam().element == "shape", relaxes = GetParam().law == "chapman";
  const Trial trial = rippled(GetParam(), two ? test::all_parts() : along_warp());
  const auto simulation = trial.simulation();
  double friction = 0, relaxed = 0;
  for (int step = 0; step < 6; ++step) {
    simulation->advance(1);
    const Ledger ledger = simulation->ledger();
    constexpr double kArithmetic = 1e-9;
    EXPECT_LT(ledger.remainder_relative, kArithmetic);
    EXPECT_GE(ledger.bending_friction, friction);
    EXPECT_GE(ledger.bending_relaxation, relaxed);
    friction = ledger.bending_friction, relaxed = ledger.bending_relaxation;
  }
  EXPECT_GT(friction, 0);
  EXPECT_EQ(relaxed > 0, relaxes);
}

// Its history is what its type has: 8 stops for each component here, 5 more vectors with branches, one with
// set.
TEST(MeasuredFabric, PaysForThePartsThatItHasAlone) {
  const auto bytes = [](const char* law, const BendingParts& parts) {
    const Trial trial = rippled({law, "shape", "semi-implicit"}, parts);
    for (const ScenePart& part : trial.simulation()->parts())
      if (part.name == "bending history") return part.bytes / trial.cloth.mesh.faces() / (3 * sizeof(double));
    return std::size_t(0);
  };
  const BendingParts all = test::all_parts();
  EXPECT_EQ(bytes("prandtl", {}), 8u);
  EXPECT_EQ(bytes("prandtl", {all.stops, {}, {}, {}}), 8u);
  EXPECT_EQ(bytes("chapman", {all.stops, {}, all.branches, {}}), 8u + 5);
  EXPECT_EQ(bytes("prandtl", {all.stops, {}, {}, all.set}), 8u + 1);
  EXPECT_EQ(bytes("chapman", all), 8u + 5 + 1);
}

}  // namespace
}  // namespace hysteron
