// These tests check in-plane friction of cloth in motion, under every integrator.
#include <gtest/gtest.h>

#include "sim/scene/scene_reader.h"
#include "tests/sim/time/scenes.h"

namespace hysteron {
namespace {

using test::Trial;

// Sheared and stretched well past the first thresholds, then let go without weight.
Trial sheared(const std::string& integrator, const InPlaneStops& stops) {
  Scene scene = test::free_square(60);
  scene.integrator = value_named<Integrator>(integrator);
  scene.fabric.in_plane = stops;
  scene.fabric.damping = 0;
  scene.gravity.setZero();
  scene.step = scene.is_implicit() ? 2e-3 : 2e-4;
  scene.newton_residual = 1e-11;
  scene.newton_velocity = 0;
  if (integrator == "quasi-static") {
    scene.step = 0.01;
    scene.pin = {test::pin_at(0, 0), test::pin_at(0.2, 0), test::pin_at(0.2, 0.2), test::pin_at(0, 0.2)};
    for (int k : {2, 3}) scene.pin[k].motion.keys = {{0}, {0.05, {0.01, 0, 0}, 0}};
  }
  Trial trial(scene);
  if (scene.pin.empty())
    for (Eigen::Vector3d& x : trial.cloth.start) {
      const Eigen::Vector3d p = x;
      x += Eigen::Vector3d(0.01 * std::sin(20 * p.y()), 0.006 * std::sin(25 * p.x()), 0);
    }
  return trial;
}

class InPlaneFrictionInMotion : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Integrators, InPlaneFrictionInMotion,
                         testing::Values("semi-implicit", "explicit", "implicit", "bdf2", "tr-bdf2",
                                         "quasi-static"),
                         test::CaseName());

TEST_P(InPlaneFrictionInMotion, LosesEnergyOfItsOwnInABalanceThatCloses) {
  const auto simulation = sheared(GetParam(), test::in_plane_stops()).simulation();
  EXPECT_EQ(simulation->ledger().membrane_friction, 0) << "what the start has dragged is no loss";
  double lost = 0;
  for (int step = 0; step < 5; ++step) {
    simulation->advance(2);
    const Ledger ledger = simulation->ledger();
    constexpr double kArithmetic = 1e-9;
    EXPECT_LT(ledger.remainder_relative, kArithmetic);
    EXPECT_GE(ledger.membrane_friction, lost);
    lost = ledger.membrane_friction;
  }
  EXPECT_GT(lost, 0);
}

// A shear of 0.05 doubles the limits; stops of warp and weft are those of triangles, or of nodes.
class GrowingFrictionInMotion : public testing::TestWithParam<MembraneElement> {};
INSTANTIATE_TEST_SUITE_P(Elements, GrowingFrictionInMotion,
                         testing::Values(MembraneElement::constant, MembraneElement::nodal),
                         [](const auto& test) { return enum_name(test.param); });

TEST_P(GrowingFrictionInMotion, LosesOtherEnergyInABalanceThatCloses) {
  InPlaneStops growing = test::in_plane_stops();
  growing.shear_growth = 20;
  for (const char* integrator : {"semi-implicit", "implicit", "quasi-static"}) {
    const auto ledger = [&](const InPlaneStops& stops) {
      Trial trial = sheared(integrator, stops);
      trial.scene.membrane_element = GetParam();
      EXPECT_NO_THROW(check_scene(trial.scene));
      return trial.after(10)->ledger();
    };
    const Ledger with = ledger(growing), without = ledger(test::in_plane_stops());
    constexpr double kArithmetic = 1e-9, kDiffers = 1e-3;  // far more than a solve leaves
    EXPECT_LT(with.remainder_relative, kArithmetic) << integrator;
    EXPECT_GT(with.membrane_friction, 0) << integrator;
    EXPECT_GT(std::abs(with.membrane_friction / without.membrane_friction - 1), kDiffers)
        << integrator << ": growth acts";
  }
}

// A chapter step takes tension apart from bending.
TEST(InPlaneFriction, LosesInTheChaptersStepsToo) {
  Trial trial = sheared("semi-implicit", test::in_plane_stops());
  trial.scene.implicit_every = ImplicitEvery::step;
  const Ledger ledger = trial.after(10)->ledger();
  EXPECT_GT(ledger.membrane_friction, 0);
  EXPECT_LT(ledger.remainder_relative, 1e-9);
}

// Memory of one number for each stop and one for what is lost, of two for shear on triangles and of three for
// warp and weft at nodes, which are vertices here; loops of its own.
TEST(InPlaneFriction, CostsNothingWhereAFabricHasNone) {
  const auto own_loops = [](const Trial& trial) {
    const auto simulation = trial.simulation();
    simulation->profile();
    simulation->advance(1);
    std::vector<std::string> names;
    for (const auto& [name, cost] : simulation->kernel_costs())
      if (name.starts_with("membrane friction") || name == "membrane history") names.push_back(name);
    return names;
  };
  const Trial without = sheared("implicit", {}), with = sheared("implicit", test::in_plane_stops());
  const ScenePart none = test::scene_part(*without.simulation(), "membrane history"),
                  some = test::scene_part(*with.simulation(), "membrane history");
  EXPECT_FALSE(none.included);
  EXPECT_EQ(none.bytes, 0u);
  EXPECT_TRUE(some.included);
  const ClothMesh& mesh = with.cloth.mesh;
  EXPECT_EQ(some.bytes, (mesh.faces() * (2 + 1) + mesh.vertices() * (3 + 1)) * sizeof(double));
  EXPECT_TRUE(own_loops(without).empty());
  EXPECT_EQ(own_loops(with), (std::vector<std::string>{"membrane friction, tried", "membrane history"}));
}

// Stops of one and of the other direction see their own strain alone.
TEST(InPlaneFriction, OfWarpAndWeftActsOnStretchAlongThem) {
  const auto lost = [](const InPlaneStops& stops, const Eigen::Vector3d& pull) {
    Scene scene = test::free_square(60);
    scene.mesh = "aligned";
    scene.integrator = Integrator::quasi_static;
    scene.gravity.setZero();
    scene.step = 0.01;
    scene.fabric.in_plane = stops;
    Pin low = test::pin_in({-1, -1, -1}, {1e-6, 1, 1}), high = test::pin_in({0.2 - 1e-6, -1, -1}, {1, 1, 1});
    if (pull.y() > 0) std::swap(low.high.x(), low.high.y()), std::swap(high.low.x(), high.low.y());
    high.motion.keys = {{0}, {0.02, pull, 0}};
    scene.pin = {low, high};
    return Trial(scene).after(2)->ledger().membrane_friction;
  };
  const Spectrum stop = {{0.005}, {300}};
  constexpr double kStretch = 0.02, kArea = 0.2 * 0.2;
  const double e = kStretch + kStretch * kStretch / 2, r = 0.005;
  const double expected = kArea * 300 * r * (e - r);  // no coupling: the stretch is uniform
  const Eigen::Vector3d along_warp(0.2 * kStretch, 0, 0), along_weft(0, 0.2 * kStretch, 0);
  constexpr double kSolved = 1e-6;  // relative: Newton's tolerance
  EXPECT_NEAR(lost({stop, {}, {}}, along_warp), expected, kSolved * expected);
  EXPECT_NEAR(lost({{}, stop, {}}, along_weft), expected, kSolved * expected);
  EXPECT_NEAR(lost({{}, stop, {}}, along_warp), 0, kSolved * expected);
  EXPECT_NEAR(lost({{}, {}, stop}, along_warp), 0, kSolved * expected);
}

}  // namespace
}  // namespace hysteron
