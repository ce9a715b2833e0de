// Friction elements with free thresholds come back from their loops.
#include "sim/identification/stops.h"

#include <gtest/gtest.h>

#include "tests/sim/identification/synthetic.h"

namespace hysteron {
namespace {

const std::vector<Stop> kTwoStops = {{15, 2e-5}, {80, 8e-6}};  // thresholds [1/m], stiffness [N m]
constexpr double kSpring = 1.2e-5;                             // [N m]

std::vector<LawRow> rows_at(const std::vector<double>& curvature) {
  std::vector<LawRow> rows;
  for (double k : curvature) rows.push_back({k});
  return rows;
}

MomentSeries loop_of_stops(double noise, unsigned seed) {
  const std::vector<double> k = path({250, -250, 250}, 80);
  return measured(k, stops_moments(kSpring, kTwoStops, rows_at(k)), noise, seed);
}

TEST(Stops, OfAnExactLoopComeBackExactly) {
  const StopsIdentification found = identify_stops(loop_of_stops(0, 1), 2, {});
  constexpr double kSolver = 1e-6;
  ASSERT_EQ(found.stops.size(), 2u);
  for (int j = 0; j < 2; ++j) {
    EXPECT_NEAR(found.stops[j].threshold / kTwoStops[j].threshold, 1, kSolver);
    EXPECT_NEAR(found.stops[j].stiffness / kTwoStops[j].stiffness, 1, kSolver);
  }
  EXPECT_NEAR(found.spring / kSpring, 1, kSolver);
  EXPECT_TRUE(found.converged);
  EXPECT_GT(found.fabric.iterations, 0);
}

TEST(Stops, ComeBackFromNoiseWithinThreeStandardErrors) {
  constexpr int kSeeds = 60;
  constexpr double kMinFraction = 0.95;  // of 60 seeds at 99.7 %, three outside are one case in 1400
  int hits[4] = {};
  for (int seed = 1; seed <= kSeeds; ++seed) {
    const StopsIdentification found = identify_stops(loop_of_stops(0.02, unsigned(seed)), 2, {});
    ASSERT_EQ(found.stops.size(), 2u) << seed;
    for (int j = 0; j < 2; ++j) {
      const Stop &stop = found.stops[j], &truth = kTwoStops[j];
      hits[2 * j] += std::abs(stop.threshold - truth.threshold) <= 3 * stop.threshold_error;
      hits[2 * j + 1] += std::abs(stop.stiffness - truth.stiffness) <= 3 * stop.stiffness_error;
    }
  }
  for (int count : hits) EXPECT_GE(count, kMinFraction * kSeeds);
}

// Their sums: slope at the start b2 + sum p, friction moment sum p r.
TEST(Stops, StateTheirSlopesAndTheirFrictionMoment) {
  const auto further = identify_stops(loop_of_stops(0, 1), 2, {}).fabric.further;
  const double g = kTwoStops[0].stiffness + kTwoStops[1].stiffness;
  const double hb =
      kTwoStops[0].stiffness * kTwoStops[0].threshold + kTwoStops[1].stiffness * kTwoStops[1].threshold;
  constexpr double kSolver = 1e-6;
  ASSERT_EQ(further.at(0).first, "stops_b1_N_m");
  EXPECT_NEAR(further[0].second / (kSpring + g), 1, kSolver);
  ASSERT_EQ(further.at(2).first, "stops_HB_N");
  EXPECT_NEAR(further[2].second / hb, 1, kSolver);
}

TEST(Stops, GiveTheFabricOfTheQuadraticLawBack) {
  const Identification fabric =
      identify_stops(measured("prandtl", kCotton, {250, -250, 250}, 0.02, 1), 4, {}).fabric;
  EXPECT_LE(std::abs(fabric.b1.value - kCotton.b1), 3 * fabric.b1.standard_error);
  EXPECT_LE(std::abs(fabric.b2.value - kCotton.b2), 3 * fabric.b2.standard_error);
  EXPECT_LE(std::abs(fabric.k0.value - kCotton.k0), 3 * fabric.k0.standard_error);
}

TEST(Stops, MoreThanTheDataShowAreDropped) {
  const StopsIdentification found = identify_stops(loop_of_stops(0.02, 1), 8, {});
  EXPECT_LE(found.stops.size(), 4u);
  constexpr double kSeveralStandardErrors = 0.02;
  EXPECT_NEAR(found.spring / kSpring, 1, kSeveralStandardErrors);
  EXPECT_NE(found.fabric.statements.at(0).find("8 friction elements"), std::string::npos);
}

// The quadratic law is the limit of many small stops: a few free ones come near its loop.
TEST(Stops, ApproachTheQuadraticLaw) {
  const MomentSeries series = measured("prandtl", kCotton, {250, -250, 250}, 0, 1);
  const double two = identify_stops(series, 2, {}).fabric.residual_rms();
  const StopsIdentification four = identify_stops(series, 4, {});
  constexpr double kOfLargest = 0.003;
  EXPECT_LT(four.fabric.residual_rms(), two);
  EXPECT_LT(four.fabric.residual_rms(), kOfLargest * series.largest_moment());
}

}  // namespace
}  // namespace hysteron
