// What FAB loops identify, as a fabric's file: scenes take it, and the virtual tester reads the same laws of
// it.
#include "sim/identification/fab_fabric.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sim/scene/fabric_reader.h"
#include "tests/sim/base/folder.h"
#include "tests/sim/base/refusal.h"

namespace hysteron {
namespace {

FabBending bending(const std::string& direction, double spring, const std::vector<double>& stiffnesses) {
  FabBending found;
  found.direction = direction;
  found.law = {spring, {4, 16, 64}, stiffnesses};
  found.stiffness_errors = {1e-7, 1e-7, 1e-7};
  found.determined = {true, true, true, false};
  return found;
}

FabTension tension(const std::string& direction, double spring, const std::vector<double>& stiffnesses) {
  FabTension found;
  found.direction = direction;
  found.law = {spring, {0.005, 0.03}, stiffnesses};
  found.stiffness_errors = {1, 1};
  found.determined = {true, true, true};
  return found;
}

void expect_same(const StopsLaw& a, const StopsLaw& b) {
  EXPECT_EQ(a.spring, b.spring);
  EXPECT_EQ(a.thresholds, b.thresholds);
  EXPECT_EQ(a.stiffnesses, b.stiffnesses);
}

TEST(FabFabric, IsOneOfScenesWithItsStopsOfBendingAndInThePlane) {
  const test::Folder folder;
  const FabIdentification found = {
      {bending("L", 4e-6, {2e-5, 2e-6, 8e-7}), bending("W", 2e-6, {1e-5, 1e-6, 5e-7})},
      {tension("L", 60, {300, 40}), tension("W", 30, {200, 20})},
      "a test"};
  const std::string file = folder.file("fabric.toml");
  write_fab_fabric(file, found, {"mine", "a test", 0.3, 2e-4});
  const Fabric fabric = read_fabric(file, "test").fabric;
  EXPECT_EQ(fabric.bending.weft_stops.stiffnesses, found.bending[1].law.stiffnesses);
  EXPECT_EQ(fabric.in_plane.warp.thresholds, found.tension[0].law.thresholds);
  EXPECT_EQ(fabric.in_plane.weft.stiffnesses, found.tension[1].law.stiffnesses);
  EXPECT_TRUE(fabric.in_plane.shear.empty());
  EXPECT_EQ(fabric.weft, 30);
  EXPECT_EQ(fabric.provenance.at("membrane.stops.warp.thresholds").confidence, "fitted");
  const FabFabric tested = fab_fabric(read_fabric(file, "test").fabric);
  EXPECT_EQ(tested.name, "mine");
  EXPECT_EQ(tested.density, 0.3);
  expect_same(tested.strip("L").bending, found.bending[0].law);
  expect_same(tested.strip("W").bending, found.bending[1].law);
  expect_same(tested.strip("L").stretch, found.tension[0].law);
  expect_same(tested.strip("W").stretch, found.tension[1].law);
}

// What scenes would refuse gets no name, and leaves nothing.
TEST(FabFabric, ThatNoSceneWouldTakeIsNotWritten) {
  const test::Folder folder;
  const FabricNotes notes{"mine", "a test", 0.3, 2e-4};
  const double no_number = std::nan("");
  for (const FabBending& bad : {bending("L", 4e-6, {0, 0, 0}), bending("L", no_number, {1e-5, 1e-6, 5e-7}),
                                bending("L", -1e-6, {1e-5, 1e-6, 5e-7})}) {
    const auto write = [&] { write_fab_fabric(folder.file("fabric.toml"), {{bad}, {}, "a test"}, notes); };
    const std::string reason = test::refusal(write, 3);
    EXPECT_TRUE(test::says(reason, "the numbers found are no fabric's, and none is written: "));
    EXPECT_FALSE(test::says(reason, ".part-"));
    EXPECT_TRUE(folder.names().empty());
  }
}

// Friction uniform on [0, k0], of which the virgin curve is M0 (2u - u^2).
TEST(FabFabric, WithoutStopsBendsAsItsThreeNumbersSay) {
  const VirginCurve curve = read_fabric("cotton-broad", "test").fabric.virgin_curve();
  const StopsLaw law = fab_fabric(read_fabric("cotton-broad", "test").fabric).strip("warp").bending;
  constexpr double kRounding = 1e-12;
  EXPECT_EQ(law.spring, curve.b2);
  EXPECT_NEAR(law.initial_stiffness(), curve.b1, kRounding * curve.b1);
  EXPECT_NEAR(law.friction(), curve.friction_moment(), kRounding * curve.friction_moment());
}

// Along a direction of rigidity q friction slides at moments sqrt(q) times those along warp.
TEST(FabFabric, WithoutStopsBendsAlongWeftAndBiasAsItsRatiosSay) {
  Fabric fabric;
  fabric.weft_bending = 1.4, fabric.bias_bending = 1.6;
  const FabFabric tested = fab_fabric(fabric);
  const StopsLaw warp = tested.strip("L").bending;
  constexpr double kRounding = 1e-12;
  for (const auto& [direction, q] : {std::pair{"W", 1.4}, {"B", 1.6}}) {
    const StopsLaw law = tested.strip(direction).bending;
    EXPECT_NEAR(law.spring / (q * warp.spring), 1, kRounding) << direction;
    EXPECT_NEAR(law.friction() / (std::sqrt(q) * warp.friction()), 1, kRounding) << direction;
  }
}

}  // namespace
}  // namespace hysteron
