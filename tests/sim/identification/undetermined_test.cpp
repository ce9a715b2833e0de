// A number that the data cannot determine is named, and one that they can is not.
#include <gtest/gtest.h>

#include "sim/identification/curve.h"
#include "sim/identification/least_squares.h"
#include "tests/sim/base/refusal.h"
#include "tests/sim/identification/synthetic.h"

namespace hysteron {
namespace {

using Names = std::vector<std::string>;

Identification undetermined(const MomentSeries& series) { return identify_curve(series, {}); }

// Within |K| < k0 the law is b1 K + c1 K^2 and Masing's branches of it: b2 and k0 enter in c1 only.
TEST(Undetermined, AreB2AndK0OfALoopFarBelowTheElasticLimit) {
  for (const double noise : {0.0, 0.02}) {
    const Identification found = undetermined(measured("prandtl", kCotton, {5, -5, 5}, noise, 1));
    EXPECT_EQ(found.undetermined(), (Names{"b2", "k0"})) << noise;
    EXPECT_FALSE(std::isfinite(found.b2.standard_error));
    constexpr double kSolver = 1e-6;
    EXPECT_LE(std::abs(found.b1.value - kCotton.b1), 3 * found.b1.standard_error + kSolver * kCotton.b1);
    ASSERT_EQ(found.further.at(0).first, "c1_N_m2");
    EXPECT_LE(std::abs(found.further[0].second - kCotton.c1()),
              3 * found.further[1].second - kSolver * kCotton.c1());
    EXPECT_DOUBLE_EQ(found.b2.value, Assumptions{}.ratio * found.b1.value);
    EXPECT_EQ(found.b2.confidence, "assumed");
  }
}

TEST(Undetermined, AreB2AndK0OfACurveThatNeverSaturates) {
  const Identification found = undetermined(measured("prandtl", kCotton, {35}, 0.01, 1));
  EXPECT_EQ(found.undetermined(), (Names{"b2", "k0"}));
  EXPECT_TRUE(test::says(found.statements.back(), "no way back"));
}

TEST(Undetermined, IsNothingOfACurveThatSaturates) {
  const Identification found = undetermined(measured("prandtl", kCotton, {400}, 0.01, 1));
  EXPECT_EQ(found.undetermined(), Names{});
  EXPECT_LE(std::abs(found.b2.value - kCotton.b2), 3 * found.b2.standard_error);
}

// 80 rows a leg of 6000/m: two of them lie on the bend that k0 shapes.
TEST(Undetermined, AreB1AndK0WhereAllRowsSlip) {
  const Identification found = undetermined(measured("prandtl", kCotton, {3000, -3000, 3000}, 0.02, 1, 40));
  EXPECT_EQ(found.undetermined(), (Names{"b1", "k0"}));
  EXPECT_EQ(found.k0.value, Assumptions{}.k0);
  ASSERT_EQ(found.further.at(0).first, "HB_N");
  EXPECT_LE(std::abs(found.further[0].second - kCotton.friction_moment()), 3 * found.further[1].second);
}

TEST(Undetermined, AreB2AndK0OfAStraightLine) {
  const Identification found = undetermined(measured("linear", kCotton, {250, -250, 250}, 0.02, 1));
  EXPECT_EQ(found.undetermined(), (Names{"b2", "k0"}));
  EXPECT_LE(std::abs(found.b1.value - kCotton.b2), 3 * found.b1.standard_error);
}

TEST(Undetermined, IsB1OfALawThatDoesNotKnowIt) {
  CurveQuestion question;
  question.law.name = "obrien";
  const Identification found =
      identify_curve(measured("obrien", kCotton, {150, -150, 150}, 0.02, 1), question);
  EXPECT_EQ(found.undetermined(), Names{"b1"});
}

// The friction of these laws is b2 times their yield, which is k0 unless it is given.
TEST(Undetermined, IsB1OfALawThatDoesNotReadItWhereverTheFitEnds) {
  constexpr int kFewRows = 20;
  for (const char* law : {"narain", "obrien", "kim"})
    for (const char* of : {"prandtl", law}) {
      CurveQuestion question;
      question.law.name = law;
      const MomentSeries series = measured(of, kCotton, {150, -150, 150}, 0.02, 1, kFewRows);
      const Identification found = identify_curve(series, question);
      EXPECT_FALSE(found.b1.determined) << law << " of " << of;
      EXPECT_FALSE(std::isfinite(found.b1.standard_error));
      EXPECT_EQ(found.b1.confidence, "assumed");
      EXPECT_DOUBLE_EQ(found.b2.value, Assumptions{}.ratio * found.b1.value);
      question.law.parameters["yield"] = "50";
      const Identification without_k0 = identify_curve(series, question);
      EXPECT_FALSE(without_k0.b1.determined || without_k0.k0.determined) << law << " of " << of;
      EXPECT_TRUE(without_k0.b2.determined || std::string(of) != law) << law;
      EXPECT_EQ(without_k0.k0.value, Assumptions{}.k0);
      EXPECT_TRUE(
          test::says(without_k0.statements.front(), "b1 and k0 are not determined: no moment of law", law));
    }
}

// An assumption that the data exclude is not made: the curve bends by more than a ratio of 0.95 allows.
TEST(Undetermined, NumbersAreNotReplacedByAnAssumptionThatTheDataContradict) {
  CurveQuestion question;
  question.assumptions.ratio = 0.95;
  const Identification found = identify_curve(measured("prandtl", kCotton, {35}, 0.01, 1), question);
  EXPECT_FALSE(found.b2.determined);
  EXPECT_EQ(found.b2.confidence, "fitted");
  EXPECT_LT(found.b2.value, 0.9 * found.b1.value);
}

// Two parameters enter only as a sum.
TEST(Covariance, OfADirectionThatTheResidualsDoNotSeeIsLarge) {
  Eigen::MatrixXd jacobian(10, 2);
  jacobian.col(0).setLinSpaced(10, 1, 2);
  jacobian.col(1) = jacobian.col(0);
  const Covariance c = covariance(jacobian, Eigen::VectorXd::Zero(10));
  EXPECT_FALSE(is_determined(std::sqrt(c.with_floor(0, 0))));
  const Eigen::Vector2d sum(1, 1);
  EXPECT_TRUE(is_determined(std::sqrt(sum.dot(c.with_floor * sum))));
}

TEST(Covariance, OfAMeanIsTheVarianceOverTheRows) {
  const int n = 1000;
  std::mt19937 random(1);
  std::normal_distribution<double> normal(0, 0.1);
  Eigen::VectorXd residuals(n);
  for (double& r : residuals) r = normal(random);
  residuals.array() -= residuals.mean();
  const Covariance c = covariance(Eigen::MatrixXd::Ones(n, 1), residuals);
  constexpr double kOfAThousand = 0.1;  // a variance of 1000 numbers is known to 4.5 %
  EXPECT_NEAR(c.matrix(0, 0) / (0.01 / n), 1, kOfAThousand);
  EXPECT_EQ(c.widening, 1);
}

// A first-order process with correlation r has n (1 - r)/(1 + r) independent rows.
TEST(Covariance, CountsRowsThatHangTogetherLess) {
  const int n = 4000;
  const double r = 0.8;
  std::mt19937 random(1);
  std::normal_distribution<double> normal(0, 0.1);
  Eigen::VectorXd residuals(n);
  for (int i = 0; i < n; ++i)
    residuals[i] = (i ? r * residuals[i - 1] : 0) + std::sqrt(1 - r * r) * normal(random);
  constexpr double kOfCorrelation = 0.15;
  const Covariance c = covariance(Eigen::MatrixXd::Ones(n, 1), residuals);
  EXPECT_NEAR(c.widening / std::sqrt((1 + r) / (1 - r)), 1, kOfCorrelation);
}

}  // namespace
}  // namespace hysteron
