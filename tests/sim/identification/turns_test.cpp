// Loops that turn between two of their rows.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sim/identification/curve.h"
#include "sim/identification/turns.h"
#include "tests/sim/identification/synthetic.h"

namespace hysteron {
namespace {

constexpr VirginCurve kSoonSaturated{1.636e-4, 1.157e-5, 8};
constexpr double kFine = 0.1;  // [1/m] between the points of the way, of which few become rows

// A law's loop along even points from rest through the turns, of which one in `every` is a row, beginning
// with number `first`.
MomentSeries rows_of_a_way(const VirginCurve& curve, const std::vector<double>& turns, int every, int first,
                           double noise, unsigned seed = 1) {
  std::vector<double> way = {0};
  for (const double turn : turns)
    for (const double direction = turn > way.back() ? 1 : -1, from = way.back();
         direction * (turn - way.back()) > kFine / 2;)
      way.push_back(from + direction * kFine * std::round(1 + std::abs(way.back() - from) / kFine));
  const std::vector<double> moment = law_moments("prandtl", curve, way);
  std::vector<double> k, m;
  for (std::size_t i = first; i < way.size(); i += every) {
    k.push_back(way[i]);
    m.push_back(moment[i]);
  }
  return measured(k, m, noise, seed);
}

bool is_told(const Identification& found) {
  return std::any_of(found.statements.begin(), found.statements.end(), [](const std::string& text) {
    return text.find("sought between the rows") != text.npos;
  });
}

// Rows 4.7/m apart miss the turns at 250/m by up to half of that, which would make k0 16 % smaller.
TEST(LoopTurningBetweenRows, GivesItsFabricBackFromEveryFirstRow) {
  constexpr double kSearch = 1e-4;  // relative: where a search for turns ends
  for (const int first : {0, 9, 20, 33, 46}) {
    const Identification found =
        identify_curve(rows_of_a_way(kSoonSaturated, {250, -250, 250}, 47, first, 0), {});
    EXPECT_NEAR(found.b1.value / kSoonSaturated.b1, 1, kSearch) << first;
    EXPECT_NEAR(found.b2.value / kSoonSaturated.b2, 1, kSearch) << first;
    EXPECT_NEAR(found.k0.value / kSoonSaturated.k0, 1, kSearch) << first;
    EXPECT_TRUE(found.undetermined().empty()) << first;
    EXPECT_TRUE(is_told(found)) << first;
  }
}

TEST(LoopTurningBetweenRows, HasStandardErrorsThatCoverTheTruth) {
  for (int seed = 1; seed <= 10; ++seed) {
    const Identification found = identify_curve(
        rows_of_a_way(kSoonSaturated, {250, -250, 250}, 40, 7 * seed % 40, 0.01, unsigned(seed)), {});
    EXPECT_LE(std::abs(found.b1.value - kSoonSaturated.b1), 3 * found.b1.standard_error) << seed;
    EXPECT_LE(std::abs(found.b2.value - kSoonSaturated.b2), 3 * found.b2.standard_error) << seed;
    EXPECT_LE(std::abs(found.k0.value - kSoonSaturated.k0), 3 * found.k0.standard_error) << seed;
  }
}

// Steps of 10/m and 17.5/m leave one row or none on the bend of 16/m after a turn.
TEST(LoopTurningBetweenRows, LeavesB1AndK0OpenWhereTooFewRowsShowTheBend) {
  constexpr double kSearch = 1e-3;
  for (const int every : {100, 175}) {
    const Identification found =
        identify_curve(rows_of_a_way(kSoonSaturated, {250, -250, 250}, every, 3, 0), {});
    EXPECT_EQ(found.undetermined(), (std::vector<std::string>{"b1", "k0"})) << every;
    EXPECT_NEAR(found.b2.value / kSoonSaturated.b2, 1, kSearch) << every;
    EXPECT_NEAR(found.curve().friction_moment() / kSoonSaturated.friction_moment(), 1, kSearch) << every;
  }
}

TEST(LoopTurningBetweenRows, IsNotSoughtWhereStepsAreSmallBesideK0) {
  EXPECT_FALSE(
      is_told(identify_curve(rows_of_a_way(kSoonSaturated, {50, -50}, 3, 0, 0), {})));  // 0.3/m < 8/m / 25
  EXPECT_TRUE(is_told(identify_curve(rows_of_a_way(kSoonSaturated, {50, -50}, 4, 0, 0), {})));
}

// Even steps of 4 along a way that turns at 9, between 8 and 6, and at -4, between -2 and -2.
TEST(SoughtTurns, LieWhereEvenStepsPutThem) {
  MomentSeries series;
  series.drive = series.curvature = {0, 4, 8, 6, 2, -2, -2, 2, 6};
  series.moment = series.drive;
  series.turns = {2, 5};
  const std::vector<SoughtTurn> turns = sought_turns(series, false, 0);
  ASSERT_EQ(turns.size(), 2u);
  EXPECT_EQ(turns[0].direction, 1);
  EXPECT_EQ(turns[0].step, 4);
  EXPECT_DOUBLE_EQ(turns[0].curvature_at(turns[0].by_even_steps), 9);
  EXPECT_DOUBLE_EQ(turns[1].curvature_at(turns[1].by_even_steps), -4);
}

// The way from 8 by 9 back to 6 is 4 long, of which the turn takes a quarter.
TEST(SoughtTurns, StandBetweenTheirRowsAndTakeTheirPartOfTheTime) {
  const std::vector<LawRow> rows = {{4, 1}, {8, 1}, {6, 2}};
  const std::vector<SoughtTurn> turns = {{1, 1, 8, 4}};
  const DrivenRows after = with_turns(rows, 3, turns, Eigen::VectorXd::Constant(1, 0.25));
  ASSERT_EQ(after.rows.size(), 4u);
  EXPECT_EQ(after.rows[2].curvature, 9);
  EXPECT_EQ(after.rows[2].seconds, 0.5);
  EXPECT_EQ(after.rows[3].seconds, 1.5);
  const DrivenRows before = with_turns(rows, 3, turns, Eigen::VectorXd::Constant(1, -0.25));
  EXPECT_EQ(before.rows[1].curvature, 9);
  EXPECT_EQ(without_added({1, 2, 3, 4}, before), (std::vector<double>{1, 3, 4}));
  EXPECT_EQ(with_turns(rows, 3, turns, Eigen::VectorXd::Zero(1)).rows.size(), 3u);
}

}  // namespace
}  // namespace hysteron
