// The heavy elastica against published and closed forms.
#include "sim/reference/elastica.h"

#include <gtest/gtest.h>
#include <omp.h>

#include <cmath>
#include <filesystem>
#include <iterator>

namespace hysteron {
namespace {

HeavyStrip linear_strip(double gamma, double b = 1) {
  HeavyStrip strip;
  strip.law = {"linear", {b, b, 0}, {}};
  strip.weight = gamma;
  return strip;
}

double drop(double gamma, int segments, double b = 1) {
  HeavyStrip strip = linear_strip(gamma, b);
  strip.segments = segments;
  return sagging_strips(strip, {1}, 20).back().drop();
}

// This struct has the drop over length for Gamma = w L^3/B, by shooting with a Runge-Kutta method of fourth
// order.
struct Known {
  double gamma, drop;
};
constexpr Known kKnown[] = {{0.1, 0.0124984}, {1, 0.1234714},   {10, 0.7001997},
                            {100, 0.9375239}, {300, 0.9650064}, {1000, 0.9811413}};

TEST(Elastica, DropsAsFarAsTheTableSays) {
  for (const Known& known : kKnown) EXPECT_NEAR(drop(known.gamma, 200) / known.drop, 1, 4e-4) << known.gamma;
}

// Drop of a strip of heaviness 10 whose load is tilted towards the free end, by the same shooting.
TEST(Elastica, DropsUnderATiltedLoadAsShootingSays) {
  constexpr std::pair<double, double> kTilted[] = {{20, 0.5890758}, {-20, 0.7775139}, {30, 0.5214700}};
  for (const auto& [degrees, drop] : kTilted) {
    HeavyStrip strip = linear_strip(10);
    strip.tilt = degrees * 3.14159265358979323846 / 180;
    EXPECT_NEAR(sagging_strips(strip, {1}, 20).back().drop() / drop, 1, 4e-4) << degrees;
  }
}

// The number of threads is for a run to say: those that dense algebra would start by itself stay alive.
TEST(Elastica, StartsNoThreads) {
  const auto threads = [] {
    using Entry = std::filesystem::directory_iterator;
    return std::distance(Entry("/proc/self/task"), Entry());
  };
  omp_set_num_threads(4);
  const auto before = threads();
  drop(10, 400);
  EXPECT_EQ(threads(), before);
}

TEST(Elastica, IsOfSecondOrder) {
  const double fine = drop(20, 320);
  EXPECT_NEAR(std::log2(std::abs(drop(20, 40) - fine) / std::abs(drop(20, 80) - fine)), 2, 0.1);
}

TEST(Elastica, NoticesARigidityThatIsOffByFivePercent) {
  EXPECT_GT(std::abs(drop(10, 100, 1.05) / kKnown[2].drop - 1), 1e-2);
  EXPECT_GT(std::abs(drop(10, 100, 0.95) / kKnown[2].drop - 1), 1e-2);
}

// For the tip at 41.5 degrees the overhang is twice the bending length c = (B/w)^(1/3) (Peirce 1930; ASTM
// D1388): to 0.02 %.
TEST(Elastica, OverhangsTwoBendingLengthsAt41Point5Degrees) {
  const double gamma = 8.004;
  const SaggingStrip strip = sagging_strips(linear_strip(gamma), {1}, 20).back();
  EXPECT_NEAR(strip.chord_angle() * 180 / 3.14159265358979323846, 41.5, 0.01);
}

// Small deflection, constant friction M0: beyond the place where the weight's moment is M0 nothing bends, and
// the tip drops by w/(8 B) (L^2 - 2 M0/w)^2; not at all if L^2 < 2 M0/w.
TEST(Elastica, DropsUnderConstantFrictionByTheClosedForm) {
  const double b = 1, m0 = 0.002, weight = 0.02, k0 = 1e-6;
  HeavyStrip strip;
  strip.law = {"bilinear", {b + 2 * m0 / k0, b, k0}, {}};
  strip.weight = weight;
  strip.segments = 200;
  const double expected = weight / (8 * b) * std::pow(1 - 2 * m0 / weight, 2);
  EXPECT_NEAR(sagging_strips(strip, {1}).back().drop() / expected, 1, 5e-3);
  strip.weight = 1.9 * m0;
  EXPECT_LT(sagging_strips(strip, {1}).back().drop(), 1e-3 * expected);
}

// Unloaded, an elastic strip is straight again; with friction it keeps a droop, within what M0 can hold: each
// curvature at most M0/b2.
TEST(Elastica, KeepsAResidualDroopWithFrictionAlone) {
  HeavyStrip strip;
  const VirginCurve cotton{3.6e-5, 1.2e-5, 50};
  strip.length = 0.1;
  strip.segments = 100;
  strip.weight = 1.2;
  strip.law = {"prandtl", cotton, {}};
  const auto friction = sagging_strips(strip, {1, 0});
  strip.law.name = "pabst";
  const auto elastic = sagging_strips(strip, {1, 0});
  EXPECT_LT(elastic[1].drop(), 1e-9);
  EXPECT_GT(friction[1].drop(), 0.05 * friction[0].drop());
  EXPECT_LT(friction[1].drop(), 0.9 * friction[0].drop());
  for (double k : friction[1].curvature) EXPECT_LE(k, cotton.friction_moment() / cotton.b2);
  // Loading follows the virgin curve in both; the friction's 16 stops by a polygon.
  EXPECT_NEAR(friction[0].drop() / elastic[0].drop(), 1, 1e-3);
}

}  // namespace
}  // namespace hysteron
