// Forms of friction beside each other, on residuals and records whose statistics are drawn.
#include "sim/identification/form_comparison.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "sim/reference/fab_test.h"

namespace hysteron {
namespace {

constexpr double kRecordWidth = 0.04;  // [m]

// Returns two records of one strip, bent down and up, with noise of this size and correlation [N].
std::vector<FabLoops> two_records(double noise, double correlation, unsigned seed) {
  const StopsLaw law{1e-5, {4, 16}, {4e-5, 1e-5}};
  std::vector<FabLoops> records;
  std::mt19937 random(seed);
  std::normal_distribution<double> normal(0, 1);
  for (const char* test : {"D1", "U1"}) {
    FabLoops loops = made_up_loops(test, 0.02, 5e-4, {2e-3, 4e-3, 6e-3}, 40);
    loops.direction = "L";
    loops.width = kRecordWidth;
    const BranchForces force = run_fab(loops, {law, law, 0}).force;
    double error = normal(random);
    for (std::size_t b = 0; b < force.size(); ++b)
      for (std::size_t i = 0; i < force[b].size(); ++i) {
        error = correlation * error + std::sqrt(1 - correlation * correlation) * normal(random);
        loops.branches[b].force[i] = force[b][i] + (noise * error + 0.01) / kRecordWidth;
      }
    records.push_back(loops);
  }
  return records;
}

TEST(Repeats, SayHowFarRecordsScatterAndHowLongTheyHangTogether) {
  constexpr double kNoise = 3e-4, kCorrelation = 0.6;
  double squares = 0, correlation = 0;
  constexpr int kDraws = 20;
  FabBendingQuestion question;
  for (unsigned seed = 1; seed <= kDraws; ++seed) {
    const std::vector<FabLoops> records = two_records(kNoise, kCorrelation, seed);
    const Repeats found = find_repeats(records, {records[0]}, question);
    ASSERT_EQ(found.of, std::vector<std::string>{"L D1 cycle 2 and U1 cycle 2"});
    squares += found.noise * found.noise / kDraws;
    correlation += found.correlation / kDraws;
  }
  // Twenty draws of some seventy rows, of which a quarter are independent, and a mean taken from each.
  EXPECT_NEAR(std::sqrt(squares) / kNoise, 1, 0.1);
  EXPECT_NEAR(correlation, kCorrelation, 0.1);
}

TEST(Repeats, AreOfTheSameDirectionGaugeAndWay) {
  std::vector<FabLoops> records = two_records(1e-4, 0, 1);
  FabBendingQuestion question;
  EXPECT_TRUE(find_repeats(records, {records[0]}, question).known());
  records[1].gauge *= 1.02;
  EXPECT_FALSE(find_repeats(records, {records[0]}, question).known());
  records[1].gauge = records[0].gauge;
  records[1].direction = "W";
  EXPECT_FALSE(find_repeats(records, {records[0]}, question).known());
  EXPECT_FALSE(find_repeats({records[0]}, {records[0]}, question).known()) << "no cycle repeats itself";
}

FabForm with_residuals(const Eigen::VectorXd& residuals, int numbers) {
  FabForm form{"one", {}};
  form.found.residuals = residuals;
  form.found.noise = 1;
  form.found.form = Eigen::VectorXd::Zero(numbers);
  return form;
}

Eigen::VectorXd drawn(int rows, double size, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal(0, size);
  Eigen::VectorXd result(rows);
  for (double& r : result) r = normal(random);
  return result;
}

// Two forms that miss the data by as much are each preferred as often as by chance.
TEST(FormComparison, PrefersNeitherOfTwoFormsThatAreAsFarFromTheData) {
  constexpr int kDraws = 400;
  int nearer = 0, farther = 0;
  for (unsigned seed = 0; seed < kDraws; ++seed) {
    const FabForm form = with_residuals(drawn(60, 1, 2 * seed), 2),
                  asked = with_residuals(drawn(60, 1, 2 * seed + 1), 2);
    const FormComparison beside = compare_forms(form, asked.found, {});
    nearer += beside.is_nearer;
    farther += beside.is_excluded;
  }
  constexpr double kExpected = 0.025 * kDraws, kFourDeviations = 13;
  EXPECT_NEAR(nearer, kExpected, kFourDeviations);
  EXPECT_NEAR(farther, kExpected, kFourDeviations);
}

TEST(FormComparison, PrefersTheFormThatIsNearerByMoreThanChanceAndItsNumbers) {
  const Eigen::VectorXd near = drawn(60, 1, 1), far = drawn(60, 3, 2);
  const FormComparison beside = compare_forms(with_residuals(far, 2), with_residuals(near, 2).found, {});
  EXPECT_TRUE(beside.is_excluded);
  EXPECT_FALSE(beside.is_nearer);
  EXPECT_TRUE(compare_forms(with_residuals(near, 2), with_residuals(far, 2).found, {}).is_nearer);
  // A gain by many numbers that mean nothing does not count.
  const double gained = 60 * (1 - 0.9 * 0.9);
  const FormComparison many =
      compare_forms(with_residuals(0.9 * near, 30), with_residuals(near, 2).found, {});
  EXPECT_NEAR(many.misfit, -gained, 0.01 * gained + 1e-9);
  EXPECT_GT(many.preference, 0);
}

// The misfit is computed here for 60 rows, one larger by a half.
TEST(FormComparison, MeasuresMisfitInTheNoiseOfRepeatsWhereTheFormAskedForIsWithinIt) {
  Eigen::VectorXd asked(60), form(60);
  for (int i = 0; i < 60; ++i) asked[i] = i % 2 ? 1 : -1;
  form = 1.5 * asked;
  FabForm other = with_residuals(form, 1);
  other.fixes_k0 = true;
  FabBending chapter = with_residuals(asked, 2).found;
  chapter.form_name = kParabolaName;
  EXPECT_NEAR(compare_forms(other, chapter, {}).misfit, 60 * 1.25, 1e-9);
  Repeats repeats{{"L D1 cycle 2 and U1 cycle 2"}, 10, 0};
  const FormComparison loud = compare_forms(other, chapter, repeats);
  EXPECT_NEAR(loud.misfit, 60 * 1.25 / 100, 1e-9);
  EXPECT_FALSE(loud.is_excluded);
  repeats.noise = 0.1;
  repeats.correlation = 0.5;  // three rows count as one
  const FormComparison quiet = compare_forms(other, chapter, repeats);
  EXPECT_NEAR(quiet.misfit, 60 * 1.25 / 3, 1e-9);
  EXPECT_TRUE(quiet.is_excluded);
}

}  // namespace
}  // namespace hysteron
