// Friction elements as a scalar law against the closed forms of Masing loops.
#include "sim/reference/stops_law.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "sim/bending/laws/bending_parts.h"
#include "sim/membrane/in_plane_friction.h"
#include "sim/reference/fab_test.h"

namespace hysteron {
namespace {

constexpr double kStopsRounding = 1e-12;

struct Driven {
  StopsLaw law;
  std::vector<double> anchors = std::vector<double>(law.stops(), 0.0);
  double x = 0, dissipated = 0;

  double go_to(double next) {
    const StopsPoint at = respond(law, anchors.data(), next);
    accept(law, anchors.data(), next);
    dissipated += at.dissipated;
    x = next;
    return at.response;
  }
};

const std::vector<StopsLaw> kLaws = {{1e-6, {60}, {6e-6}},
                                     {2e-6, {4, 32, 256}, {4e-5, 1e-6, 1e-7}},
                                     {5e-6, {15, 40, 90, 180}, {1e-5, 2e-6, 0, 1e-6}}};

TEST(StopsLaw, DissipatesTheClosedFormInACycle) {
  for (const StopsLaw& law : kLaws)
    for (const double amplitude : {3.0, 50.0, 400.0}) {
      Driven point{law};
      point.go_to(amplitude);
      const double before = point.dissipated;
      point.go_to(-amplitude);
      point.go_to(amplitude);
      const double area = Spectrum{law.thresholds, law.stiffnesses}.loop_area(amplitude);
      EXPECT_NEAR(point.dissipated - before, area, kStopsRounding * (1 + area));
    }
}

// A branch is y - y_r = 2 f((x - x_r)/2) (Masing 1926).
TEST(StopsLaw, ReturnsByTheVirginCurveDoubled) {
  for (const StopsLaw& law : kLaws) {
    Driven point{law};
    const double reversal = point.go_to(300);
    for (const double change : {-5.0, -60.0, -250.0}) {
      Driven virgin{law};
      const double doubled = 2 * virgin.go_to(change / 2);
      EXPECT_NEAR(point.go_to(300 + change) - reversal, doubled, kStopsRounding * std::abs(reversal));
    }
  }
}

TEST(StopsLaw, StatesItsWidthAsTwiceTheSumOfItsMoments) {
  for (const StopsLaw& law : kLaws) {
    Driven point{law};
    point.go_to(2000);
    const double down = point.go_to(0);
    point.go_to(-2000);
    EXPECT_NEAR(point.go_to(0) - down, 2 * law.friction(), kStopsRounding);
    EXPECT_NEAR(-down, law.friction(), kStopsRounding);
  }
}

TEST(StopsLaw, HasAPotentialWhoseSlopeIsItsResponse) {
  const StopsLaw& law = kLaws[1];
  Driven point{law};
  point.go_to(120);
  const auto potential = [&](double x) {
    const StopsPoint at = respond(law, point.anchors.data(), x);
    return at.stored + at.dissipated;
  };
  const double step = 1e-3;
  for (const double x : {119.0, 90.0, -30.0}) {
    const double slope = (potential(x + step) - potential(x - step)) / (2 * step);
    const double response = respond(law, point.anchors.data(), x).response;
    EXPECT_NE(response, 0);
    EXPECT_NEAR(slope, response, 1e-8 * std::abs(response));
  }
}

// The same law is written twice, by its integral here and by the ways slipped there.
TEST(StopsLaw, WithLimitsThatGrowIsThatOfTheMembranesShear) {
  constexpr double g = 14;
  const std::vector<StrainStop<double>> stops = {{0.004, 300}, {0.03, 50}};
  StopsLaw law{0, {0.004, 0.03}, {300, 50}};
  for (const double r : law.thresholds) law.growths.push_back(g * r);
  Driven point{law};
  double slip[2] = {0, 0};
  const StrainStops<double> membrane{stops.data(), {0, 0, 0, 2}, slip, 1, g};
  std::mt19937 random(3);
  std::uniform_real_distribution<double> shear(-0.2, 0.2);
  for (int step = 0; step < 300; ++step) {
    const double x = shear(random), before = point.dissipated;
    const StopsReply<double> there = membrane.reply(0, {0, 0, x});
    const StopsPoint here = respond(law, point.anchors.data(), x);
    EXPECT_NEAR(point.go_to(x), there.stress[2], 300 * kStopsRounding);
    EXPECT_NEAR(here.tangent, there.tangent[2], 300 * kStopsRounding);
    EXPECT_NEAR(here.stored, there.stored, kStopsRounding);
    EXPECT_NEAR(point.dissipated - before, there.lost, kStopsRounding * (1 + point.dissipated));
    membrane.accept(0, {0, 0, x});
  }
  EXPECT_GT(point.dissipated, 1);
}

const StopsLaw kTension{20, {0.005, 0.03}, {200, 40}};  // [N/m] against strain
constexpr double kStripLength = 0.02;

TEST(StretchedStrip, PullsByItsVirginCurve) {
  StretchedStripTest test(kTension, kStripLength);
  test.go_to(kStripLength * 1.1);
  EXPECT_NEAR(test.force(), 20 * 0.1 + 200 * 0.005 + 40 * 0.03, 1e-9);
}

// From y_m = f(A) down to zero by the doubled virgin curve: there it goes slack, and keeps that strain.
TEST(StretchedStrip, GoesSlackWhereTheMasingBranchMeetsZero) {
  StretchedStripTest test(kTension, kStripLength);
  test.go_to(kStripLength * 1.1);
  test.go_to(kStripLength);
  EXPECT_TRUE(test.slack());
  // Both stops have turned around: 20 e = 200 * 0.005 + 40 * 0.03.
  const double strain = (200 * 0.005 + 40 * 0.03) / 20;
  ASSERT_GT(strain, 0.1 - 2 * 0.03);  // so that the second has not; then 20 e + 40 (e - 0.1 + 0.03) = 1
  const double partly = (1 + 40 * 0.07) / 60;
  EXPECT_NEAR(test.strain(), partly, 1e-12);
  test.go_to(kStripLength * 1.02);
  EXPECT_TRUE(test.slack());
  EXPECT_NEAR(test.strain(), partly, 1e-12);
}

TEST(StretchedStrip, EnclosesWhatItDissipates) {
  StretchedStripTest test(kTension, kStripLength);
  double work = 0, distance = kStripLength, force = 0;
  for (const double to : {1.1, 1.0, 1.2, 1.0})
    for (const double from = distance; distance != kStripLength * to;) {
      const double next = std::abs(kStripLength * to - distance) < 1.5e-7
                              ? kStripLength * to
                              : distance + std::copysign(1e-7, kStripLength * to - from);
      test.go_to(next);
      work += (force + test.force()) / 2 * (next - distance);
      distance = next;
      force = test.force();
    }
  EXPECT_NEAR((work - test.energy()) / test.dissipated(), 1, 1e-4);
}

}  // namespace
}  // namespace hysteron
