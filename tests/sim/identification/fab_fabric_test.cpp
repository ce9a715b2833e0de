// FAB loops identify a fabric, written as a file: scenes take it, and the virtual tester reads the same laws
// of it.
#include "sim/identification/fab_fabric.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sim/bending/laws/spectrum_stops.h"
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

TEST(FabFabric, HasTheBiasThatWasFittedOrTheMeanOfBothDirections) {
  const test::Folder folder;
  FabIdentification found = {{bending("L", 4e-6, {2e-5, 2e-6, 8e-7}), bending("W", 2e-6, {1e-5, 1e-6, 5e-7})},
                             {tension("L", 60, {300, 40}), tension("W", 30, {200, 20})},
                             "a test"};
  const std::string file = folder.file("fabric.toml");
  const auto bias = [&] {
    write_fab_fabric(file, found, {"mine", "a test", 0.3, 2e-4});
    return read_fabric(file, "test").fabric.bias_bending;
  };
  EXPECT_DOUBLE_EQ(bias(), 0.75);
  found.bending.push_back(bending("B", 6e-6, {1e-5, 1e-6, 5e-7}));
  EXPECT_DOUBLE_EQ(bias(), 1.5);
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

// A fabric that scenes would refuse gets no name, and leaves nothing.
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

// B is multiplied by (1 + 0.5)/2 and friction by (1 + 2)/2, with or without stops.
TEST(FabFabric, WhoseFacesDifferBendsAsTheMeanOfBoth) {
  Fabric alike;
  alike.weft_bending = 0.8;
  for (const bool stops : {false, true}) {
    if (stops) alike.bending.stops = {{4, 16, 64}, {2e-5, 2e-6, 8e-7}};
    Fabric differ = alike;
    differ.bending.faces.bending = 0.5, differ.bending.faces.friction = 2;
    constexpr double kRounding = 1e-12;
    for (const char* direction : {"L", "W", "B"}) {
      const StopsLaw mean = fab_fabric(differ).strip(direction).bending;
      const StopsLaw one = fab_fabric(alike).strip(direction).bending;
      EXPECT_NEAR(mean.spring / one.spring, 0.75, kRounding) << direction;
      EXPECT_NEAR(mean.friction() / one.friction(), 1.5, kRounding) << direction;
    }
  }
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

// A bend along the bias by the face element's own law: the tensor (1/2, 1/2, 2^-1/2) K of a cylinder, metric
// and all, as cloth bends.
double cloth_moment_along_bias(const Fabric& fabric, double curvature) {
  const double weft = fabric.weft_bending, twist = 2 * fabric.bias_bending - (1 + weft) / 2;
  const Vec<double, 3> root{1, std::sqrt(weft), std::sqrt(twist)}, along{0.5, 0.5, std::sqrt(0.5)};
  const VirginCurve curve = fabric.virgin_curve();
  const auto law = SpectrumStops<double, 3, 8>::make(curve.b2, curve.parts.stops, curve.parts.weft_stops);
  const auto step = law.step(curvature * root.cwiseProduct(along), {});
  return root.cwiseProduct(step.moment).dot(along);
}

double virgin_response(const StopsLaw& law, double x) {
  const std::vector<double> anchors(law.stops(), 0.0);
  return respond(law, anchors.data(), x).response;
}

// While every stop is held the moments are those of the tensor; the corner of each stop is chosen.
TEST(FabFabric, WithStopsAlongWeftBendsAlongTheBiasAsClothDoes) {
  Fabric fabric;
  fabric.bending.stops = {{4, 16, 64}, {2e-5, 2e-6, 8e-7}};
  fabric.bending.weft_stops = {{5, 12, 80}, {1e-5, 1e-6, 5e-7}};
  fabric.weft_bending = 0.6;
  constexpr double kRounding = 1e-12, kHeld = 0.5;  // [1/m]
  for (const double bias : {0.75, 1.4}) {
    fabric.bias_bending = bias;
    const StopsLaw law = fab_fabric(fabric).strip("B").bending;
    EXPECT_NEAR(law.spring / (bias * fabric.b2), 1, kRounding) << bias;
    EXPECT_NEAR(virgin_response(law, kHeld) / cloth_moment_along_bias(fabric, kHeld), 1, kRounding) << bias;
  }
}

// Where the spectrum along weft is that of the metric, the bias has it, too, as without one.
TEST(FabFabric, WithTheMetricsStopsAlongWeftBendsAlongTheBiasAsWithoutThem) {
  Fabric fabric;
  fabric.weft_bending = 0.6, fabric.bias_bending = 1.1;
  fabric.bending.stops = {{4, 16, 64}, {2e-5, 2e-6, 8e-7}};
  const StopsLaw without = fab_fabric(fabric).strip("B").bending;
  Spectrum weft = fabric.bending.stops;
  for (double& r : weft.thresholds) r /= std::sqrt(fabric.weft_bending);
  for (double& p : weft.stiffnesses) p *= fabric.weft_bending;
  fabric.bending.weft_stops = weft;
  const StopsLaw with = fab_fabric(fabric).strip("B").bending;
  constexpr double kRounding = 1e-12;
  EXPECT_NEAR(with.spring / without.spring, 1, kRounding);
  for (int j = 0; j < 3; ++j) {
    EXPECT_NEAR(with.thresholds[j] / without.thresholds[j], 1, kRounding);
    EXPECT_NEAR(with.stiffnesses[j] / without.stiffnesses[j], 1, kRounding);
  }
}

// Held at its width cloth resists stretch along the bias with (C11 + C22 + 2 C12)/4 + G; friction along warp
// slips at twice its own strain, with a quarter of its stiffness, that of shear at its own.
TEST(FabFabric, StretchesAlongTheBiasAgainstShear) {
  Fabric fabric;
  fabric.warp = 900, fabric.weft = 500, fabric.coupling = 40;
  constexpr double kStrain = 1e-3, kRounding = 1e-12;
  for (const double shear : {10.0, 40.0, 200.0}) {
    fabric.shear = shear;
    const double expected = (900 + 500 + 2 * 40) / 4.0 + shear;  // [N/m]
    EXPECT_NEAR(virgin_response(fab_fabric(fabric).strip("B").stretch, kStrain) / (expected * kStrain), 1,
                kRounding);
  }
  const double elastic = fab_fabric(fabric).strip("B").stretch.spring;
  fabric.in_plane.warp = {{0.002}, {80}};
  fabric.in_plane.shear = {{0.003}, {30}};
  const StopsLaw law = fab_fabric(fabric).strip("B").stretch;
  EXPECT_NEAR(virgin_response(law, kStrain) / ((elastic + 80 / 4.0 + 30) * kStrain), 1, kRounding);
  EXPECT_NEAR(virgin_response(law, 0.01) / (elastic * 0.01 + 0.002 * 80 / 2 + 0.003 * 30), 1, kRounding);
  // The shear is the strain along the bias: its stop's limit grows by that, and warp's does not.
  fabric.in_plane.shear_growth = 20;
  const StopsLaw growing = fab_fabric(fabric).strip("B").stretch;
  EXPECT_NEAR(virgin_response(growing, 0.01) / (elastic * 0.01 + 0.002 * 80 / 2 + 0.003 * 1.2 * 30), 1,
              kRounding);
}

}  // namespace
}  // namespace hysteron
