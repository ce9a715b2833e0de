// The virtual KES-FB1 tests against closed forms.
#include "sim/reference/kes_in_plane.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sim/base/error.h"

namespace hysteron {
namespace {

constexpr double kRounding = 1e-9;   // relative: sums of some thousand rows
constexpr double kTrapezium = 1e-6;  // of an integral over 2000 rows
constexpr double kHalfDegree = 0.5;

double tangent(double degrees) { return std::tan(degrees * kDegree); }

TEST(KesShear, OfAnElasticFabricIsItsStiffnessWithoutWidth) {
  const ShearTest test = test_shear({{1000, {}, {}}, {60, {}, {}}});
  const double g = 60 * (tangent(2.5) - tangent(kHalfDegree)) / (2 * kDegree);  // of shear, tan(angle)
  EXPECT_NEAR(test.reading.stiffness, g, kRounding * g);
  EXPECT_NEAR(test.reading.width, 0, kRounding * g);
  EXPECT_NEAR(test.reading.loop_area, 0, kRounding * g);
}

// A shear loop is read as a bending loop is, whose closed form kes_pair() has.
TEST(KesShear, ReadsStopsAsTheirMasingLoopSays) {
  const Spectrum stops = {{0.004, 0.03, 0.09}, {400, 60, 15}};
  const ShearTest test = test_shear({{1e4, {0.002}, {2e4}}, {100, stops.thresholds, stops.stiffnesses}});
  KesProtocol protocol;
  protocol.amplitude = tangent(8);
  protocol.slope_from = tangent(kHalfDegree), protocol.slope_to = tangent(2.5);
  protocol.width_at = tangent(kHalfDegree);
  VirginCurve curve{100, 100, 0};
  curve.parts.stops = stops;
  const KesPair first = kes_pair(curve, protocol);
  protocol.width_at = tangent(5);
  const KesPair second = kes_pair(curve, protocol);
  const double stiffness = first.rigidity * (protocol.slope_to - protocol.slope_from) / (2 * kDegree);
  EXPECT_NEAR(test.reading.stiffness, stiffness, kRounding * stiffness);
  EXPECT_NEAR(test.reading.width, first.loop_width, kRounding * first.loop_width);
  EXPECT_NEAR(test.reading.second_width, second.loop_width, kRounding * first.loop_width);
  EXPECT_LT(test.reading.second_width, test.reading.width) << "no loop of stops widens towards its ends";
}

// A stop that slips at r (1 + g |x|) widens the loop in proportion, and adds its growth to the slope.
TEST(KesShear, ReadsGrowthInTheWidthsAndInTheSlope) {
  constexpr double r = 0.004, p = 400, g = 12, elastic = 100;
  Fabric fabric;
  fabric.shear = elastic;
  fabric.in_plane.shear = {{r}, {p}};
  fabric.in_plane.shear_growth = g;
  const ShearReading read = test_shear(in_plane_law(fabric, Along::warp)).reading;
  const double slope = (elastic + p * r * g) * (tangent(2.5) - tangent(kHalfDegree)) / (2 * kDegree);
  EXPECT_NEAR(read.stiffness, slope, kRounding * slope);
  for (const auto& [width, angle] : {std::pair(read.width, kHalfDegree), {read.second_width, 5.0}}) {
    const double expected = 2 * p * r * (1 + g * tangent(angle));
    EXPECT_NEAR(width, expected, kRounding * expected) << angle;
  }
}

// The clamps come apart as the weight stretches the cloth: C E l = T.
TEST(KesShear, KeepsTheWeightInBalance) {
  constexpr double kStiffness = 1000;
  const InPlaneProtocol protocol;
  const ShearTest test = test_shear({{kStiffness, {}, {}}, {60, {}, {}}}, protocol);
  for (std::size_t i = 0; i < test.force.size(); i += 50) {
    const double l = test.walk.stretch[i], g = test.walk.shear.rows[i].curvature;
    const double tension = kStiffness * (l * l + g * g - 1) / 2 * l;
    EXPECT_NEAR(tension, protocol.weight, kRounding * protocol.weight);
  }
  EXPECT_NEAR(protocol.weight, 9.80665, kRounding) << "10 gf/cm";
}

// int T de = int S dE: WT = C E^2/2, all of which comes back.
TEST(KesTension, OfAnElasticFabricIsItsStoredEnergy) {
  constexpr double kStiffness = 5000;
  const TensionTest test = test_tension({{kStiffness, {}, {}}, {60, {}, {}}});
  const double e = test.reading.extension / 100, strain = e + e * e / 2;
  EXPECT_NEAR(kStiffness * strain * (1 + e), 490.3325, kRounding * 500);  // 500 gf/cm
  EXPECT_NEAR(test.reading.work, kStiffness * strain * strain / 2, kTrapezium * test.reading.work);
  EXPECT_NEAR(test.reading.resilience, 100, 100 * kTrapezium);
  EXPECT_NEAR(test.reading.linearity, test.reading.work / (490.3325 * e / 2), kRounding);
}

// With a stop that has slipped both on the way out and on the way back, where S = C E - p r at the end:
//   WT = C E^2/2 + p r (E - r/2),   back C (E^2 - E0^2)/2 - p r (E - E0 - 2r),   E0 = p r/C
TEST(KesTension, WithAStopGivesBackWhatItsClosedFormSays) {
  constexpr double c = 5000, r = 0.002, p = 10000;
  const TensionTest test = test_tension({{c, {r}, {p}}, {60, {}, {}}});
  const double e = test.reading.extension / 100, strain = e + e * e / 2, left = p * r / c;
  ASSERT_GT(strain - left, 2 * r);
  const double work = c * strain * strain / 2 + p * r * (strain - r / 2);
  const double back = c * (strain * strain - left * left) / 2 - p * r * (strain - left - 2 * r);
  EXPECT_NEAR(test.reading.work, work, kTrapezium * work);
  EXPECT_NEAR(test.reading.resilience, 100 * back / work, 100 * kTrapezium);
  EXPECT_NEAR(test.force.back(), 0, 1e-3 * test.force[test.turn]);
}

TEST(KesTension, RefusesAFabricThatStretchesToTwiceItsLength) {
  EXPECT_THROW(test_tension({{10, {}, {}}, {60, {}, {}}}), Error);
}

}  // namespace
}  // namespace hysteron
