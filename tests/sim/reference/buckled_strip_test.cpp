// A strip buckled between clamps is compared with the elastica's closed form, and its energy is checked.
#include "sim/reference/buckled_strip.h"

#include <gtest/gtest.h>

#include <cmath>

namespace hysteron {
namespace {

using Start = BuckledStripTest::Start;

constexpr double kLength = 0.021, kRigidity = 3e-6;  // [m], [N m]
const StopsLaw kStops{1e-6, {15, 40, 90, 180}, {1.5e-6, 1e-6, 5e-7, 5e-7}};

BuckledStrip elastic(int elements) { return {{kRigidity, {}, {}}, kLength, 0, elements}; }

// Clamped elastica of modulus k: P = 16 K^2 B/L^2 at the distance L (2 E/K - 1), curvature 8 k K/L at the
// clamps and in the middle (Love 1927, section 263; a quarter of it is a cantilever).
double clamp_distance(double k) { return kLength * (2 * std::comp_ellint_2(k) / std::comp_ellint_1(k) - 1); }
double elastica_force(double k) {
  return 16 * std::pow(std::comp_ellint_1(k), 2) * kRigidity / (kLength * kLength);
}

double force_error(double k, int elements) {
  BuckledStripTest test(elastic(elements), clamp_distance(0.1), Start::virgin);
  test.go_to(clamp_distance(k));
  return test.force() / -elastica_force(k) - 1;
}

TEST(BuckledStrip, PushesAsTheClampedElasticaDoes) {
  for (const double k : {0.2, 0.5, 0.7}) EXPECT_LT(std::abs(force_error(k, 32)), 1e-3) << k;
}

TEST(BuckledStrip, IsOfSecondOrderInItsElements) {
  EXPECT_NEAR(std::log2(force_error(0.5, 16) / force_error(0.5, 32)), 2, 0.05);
  EXPECT_NEAR(std::log2(force_error(0.5, 32) / force_error(0.5, 64)), 2, 0.05);
}

TEST(BuckledStrip, BendsMostAsTheClampedElasticaDoes) {
  BuckledStripTest test(elastic(128), clamp_distance(0.5), Start::virgin);
  EXPECT_NEAR(test.peak_curvature() * kLength / (8 * 0.5 * std::comp_ellint_1(0.5)), 1, 1e-3);
}

TEST(BuckledStrip, KeepsItsLengthBetweenTheClamps) {
  BuckledStripTest test({kStops, kLength, 3, 32}, 0.0195, Start::relaxed);
  test.go_to(0.0125);
  const auto line = test.line();
  EXPECT_NEAR(line.back().x(), 0.0125, 1e-9);
  EXPECT_NEAR(line.back().y(), 0, 1e-12);
}

// Small strain: an elastica buckled at first pushes by 4 pi^2 B/L^2 (Euler 1744).
TEST(BuckledStrip, BeginsAtTheLoadOfEuler) {
  BuckledStripTest test(elastic(128), kLength * (1 - 1e-5), Start::virgin);
  EXPECT_NEAR(test.force() / (-4 * M_PI * M_PI * kRigidity / (kLength * kLength)), 1, 2e-4);
}

struct Cycle {
  double work = 0, stored = 0, dissipated = 0;
};

Cycle buckling_cycle(const BuckledStrip& strip, int steps) {
  BuckledStripTest test(strip, 0.0195, Start::relaxed);
  Cycle sum;
  const double before = test.energy();
  double distance = test.distance(), force = test.force();
  for (int i = 1; i <= 2 * steps; ++i) {
    const int from_start = i <= steps ? i : 2 * steps - i;
    test.go_to(0.0195 - 0.0075 * from_start / steps);
    sum.work += (force + test.force()) / 2 * (test.distance() - distance);
    distance = test.distance();
    force = test.force();
  }
  sum.stored = test.energy() - before;
  sum.dissipated = test.dissipated();
  return sum;
}

TEST(BuckledStrip, LosesWhatTheClampsSpendAndDoNotGetBack) {
  for (const double weight : {-3.0, 0.0, 3.0}) {
    const Cycle cycle = buckling_cycle({kStops, kLength, weight, 32}, 200);
    EXPECT_GT(cycle.dissipated, 0);
    EXPECT_NEAR((cycle.work - cycle.stored) / cycle.dissipated, 1, 1e-4) << weight;
  }
}

// The second of two equal cycles closes: its area is the sum of what the stops of all points lose.
TEST(BuckledStrip, EnclosesInAClosedLoopWhatItsPointsDissipate) {
  BuckledStripTest test({kStops, kLength, 0, 32}, 0.0195, Start::relaxed);
  const auto go_around = [&] {
    double area = 0, distance = test.distance(), force = test.force();
    for (int i = 1; i <= 400; ++i) {
      test.go_to(0.0195 - 0.0075 * (i <= 200 ? i : 400 - i) / 200);
      area += (force + test.force()) / 2 * (test.distance() - distance);
      distance = test.distance();
      force = test.force();
    }
    return area;
  };
  go_around();
  const double lost = test.dissipated(), force = test.force();
  const double area = go_around();
  EXPECT_NEAR(test.force(), force, 1e-6 * std::abs(force));
  EXPECT_NEAR(area / (test.dissipated() - lost), 1, 1e-4);
}

// Friction of threshold nothing: F_back - F_out encloses 2 HB int |dK| ds, the change of the bend.
TEST(BuckledStrip, LosesTwiceTheFrictionMomentTimesTheChangeOfBend) {
  const double threshold = 1e-2, moment = 5e-5;
  const BuckledStrip strip{{kRigidity, {threshold}, {moment / threshold}}, kLength, 0, 64};
  BuckledStripTest test(strip, 0.0195, Start::relaxed);
  const double before = test.bend();
  test.go_to(0.0125);
  const double turned = test.bend() - before;
  test.go_to(0.0195);
  EXPECT_NEAR(test.dissipated() / (2 * moment * turned), 1, 1e-2);
}

TEST(BuckledStrip, NeverGivesEnergyBack) {
  BuckledStripTest test({kStops, kLength, -3, 32}, 0.0195, Start::relaxed);
  double before = 0;
  for (const double distance : {0.0171, 0.0185, 0.0175, 0.0195, 0.0147, 0.016, 0.0152, 0.0195}) {
    const double from = test.distance();
    for (int i = 1; i <= 20; ++i) {
      test.go_to(from + (distance - from) * i / 20);
      EXPECT_GE(test.dissipated(), before);
      before = test.dissipated();
    }
  }
  EXPECT_GT(before, 0);
}

// The bend up is pushed less than the bend down is: the weight of a bend down helps to close the clamps.
TEST(BuckledStrip, IsHeldUpByTheClampsAgainstItsWeight) {
  const auto push = [](double weight) {
    BuckledStripTest test({{kRigidity, {}, {}}, kLength, weight, 64}, 0.0175, Start::virgin);
    return -test.force();
  };
  EXPECT_GT(push(1), push(0));
  EXPECT_LT(push(-1), push(0));
}

}  // namespace
}  // namespace hysteron
