#include "tests/examples/hinge/hinge_loop.h"

#include <gtest/gtest.h>

namespace {

constexpr double kB1 = 3e-5, kB2 = 1e-5, kK0 = 50;  // [N m], [1/m]
constexpr double kM0 = (kB1 - kB2) * kK0 / 2;       // friction moment [N]
constexpr double kStops = kM0 / (8 * 8);            // by which 8 stops miss the virgin curve [N]
constexpr double kLength = 0.01, kHeight = 0.005;   // [m]
constexpr double kRounding = 1e-12;

struct Bent {
  Law law = Law::make({kB1, kB2, kK0});
  std::vector<Hinge> hinges = {{kLength, kHeight}};
  double lost = 0;

  double moment_at(double curvature) {
    lost += bend(law, hinges, {curvature * kHeight});
    return hinges[0].torque / kLength;
  }
};

TEST(HingeLoopExample, FollowsTheVirginCurve) {
  Bent cloth;
  for (double k = 5; k <= 100; k += 5) {
    const double curve = k < kK0 ? kB1 * k + (kB2 - kB1) / (2 * kK0) * k * k : kM0 + kB2 * k;
    EXPECT_NEAR(cloth.moment_at(k), curve, kStops * (1 + kRounding)) << k;
  }
}

// Beyond 2 K0 all stops slide: a cycle's loop is 2 M0 wide, less what the stops' thresholds keep open.
TEST(HingeLoopExample, LosesTheAreaOfItsLoopInACycle) {
  constexpr double kAmplitude = 4 * kK0;
  Bent cloth;
  cloth.moment_at(kAmplitude);
  const double before = cloth.lost;
  cloth.moment_at(-kAmplitude);
  cloth.moment_at(kAmplitude);
  double area = 0;  // of 8 stops (prandtl_stops.h), each of which loses 4 p r (A - r)
  for (int j = 1; j <= 8; ++j) {
    const double p = (kB1 - kB2) * (2 * j - 1) / 64, r = (j * j - j + 0.5) * kK0 / 64;
    area += 4 * p * r * (kAmplitude - r);
  }
  EXPECT_NEAR(cloth.lost - before, area * kLength * kHeight, kRounding * area);
}

}  // namespace
