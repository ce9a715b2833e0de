// Virgin curve and the numbers a fabric is made of: model of Wong, Eqs. 4.2, 4.4, 4.5, and KES conversions.
#include <gtest/gtest.h>

#include "sim/bending/laws/linear.h"
#include "sim/bending/laws/pabst.h"
#include "sim/bending/laws/prandtl_stack.h"
#include "sim/bending/laws/prandtl_stops.h"
#include "sim/bending/laws/wong.h"
#include "tests/sim/bending/laws/law_fixtures.h"

namespace hysteron::testing {
namespace {

constexpr double kCurveRounding = 1e-14;  // of the moment at the end of the sweep: a few roundings per step

double virgin_moment(const VirginCurve& c, double k) {
  return k <= c.k0 ? c.b1 * k + c.c1() * k * k : c.friction_moment() + c.b2 * k;
}

template <class Law>
void expect_virgin_curve(const Law& law, double tolerance) {
  Driven<Law> cloth(law), mirrored(law);
  for (int i = 1; i <= 60; ++i) {
    const double k = kCotton.k0 * i / 20;
    EXPECT_NEAR(cloth.moment(k), virgin_moment(kCotton, k), tolerance);
    EXPECT_NEAR(mirrored.moment(-k), -virgin_moment(kCotton, k), tolerance);
  }
}

TEST(VirginCurve, IsContinuousWithItsSlopeAtTheElasticLimit) {
  EXPECT_NEAR(kCotton.b1 * kCotton.k0 + kCotton.c1() * kCotton.k0 * kCotton.k0,
              kCotton.elastic_limit_moment(), kCurveRounding * kCotton.elastic_limit_moment());
  EXPECT_NEAR(kCotton.b1 + 2 * kCotton.c1() * kCotton.k0, kCotton.b2, kCurveRounding * kCotton.b1);
}

TEST(VirginCurve, FrictionMomentIsTheSizeOfTheQuadraticTermAtTheElasticLimit) {
  EXPECT_GT(kCotton.b1, kCotton.b2);  // the chapter prints b1 <= b2
  EXPECT_LT(kCotton.c1(), 0);
  EXPECT_NEAR((kCotton.b2 - kCotton.b1) / (2 * kCotton.c1()), kCotton.k0, kCurveRounding * kCotton.k0);
  EXPECT_NEAR((kCotton.b1 - kCotton.b2) * kCotton.k0 + kCotton.c1() * kCotton.k0 * kCotton.k0,
              kCotton.friction_moment(),
              kCurveRounding);  // Wong, under 4.2
  EXPECT_NEAR(-kCotton.c1() * kCotton.k0 * kCotton.k0, kCotton.friction_moment(), kCurveRounding);
}

TEST(VirginCurve, FollowsFromKesNumbers) {
  constexpr double kGramForceCm2PerCm = 9.80665e-5, kGramForceCmPerCm = 9.80665e-3;  // N m, N
  const double b = 0.118 * kGramForceCm2PerCm, hb = 0.062 * kGramForceCmPerCm, k0 = 50;
  const VirginCurve c{b + 2 * hb / k0, b, k0};
  EXPECT_NEAR(c.friction_moment(), hb, kCurveRounding);
  EXPECT_NEAR(c.b2, 1.157e-5, 0.0005e-5);  // cotton broad, rounded in its source
  EXPECT_NEAR(2 * c.friction_moment(), 1.216e-3, 0.0005e-3);
}

TEST(VirginCurve, IsFollowedByPabstWongAndTheStack) {
  const double tolerance = kCurveRounding * kCotton.elastic_limit_moment() * 3;
  expect_virgin_curve(Pabst<double, 1>::make(kCotton), tolerance);
  expect_virgin_curve(Wong<double>::make(kCotton), tolerance);
  expect_virgin_curve(PrandtlStack<double, 8>::make(kCotton), tolerance);
}

// At the thresholds it is largest: between the ends of stretches of [0, k0] that a stop stands for.
template <int N>
double worst_virgin_error() {
  Driven cloth(PrandtlStops<double, 1, N>::make(kCotton));
  double worst = 0;
  for (const double k : cloth.law.limit)
    worst = std::max(worst, std::abs(cloth.moment(k) - virgin_moment(kCotton, k)));
  return worst;
}

// The last stretch is the longest, l = (2N - 1)/N^2 of k0; the parabola rises above its chord by M0 l^2/4.
template <int N>
void expect_virgin_error() {
  constexpr double kExact = 1e-10;  // only rounding is left
  constexpr double kLongest = (2. * N - 1) / (N * N);
  EXPECT_NEAR(worst_virgin_error<N>() / kCotton.friction_moment(), kLongest * kLongest / 4, kExact);
  EXPECT_LT(worst_virgin_error<N>(), kCotton.friction_moment() / (N * N));
}

TEST(VirginCurve, StopsMissItByLessThanTheFrictionMomentOverTheirNumberSquared) {
  expect_virgin_error<4>();
  expect_virgin_error<8>();
  expect_virgin_error<32>();
}

template <int N>
void expect_exact_ends() {
  Driven cloth(PrandtlStops<double, 1, N>::make(kCotton));
  constexpr double kRounding = 1e-14;
  for (int j = 1; j <= N; ++j) {
    const double k = kCotton.k0 * j * j / (N * N);
    EXPECT_NEAR(cloth.moment(k), virgin_moment(kCotton, k), kRounding * kCotton.b1 * kCotton.k0 * N);
  }
}

TEST(VirginCurve, StopsAreOnItAtTheEndsOfTheirStretches) {
  expect_exact_ends<8>();
  expect_exact_ends<16>();
}

template <class Law>
void expect_doubled_branch(const Law& law, double tolerance) {
  const double m0 = kCotton.friction_moment(), kr = 4 * kCotton.k0, beta1 = kCotton.b2 + 2 * m0 / kCotton.k0,
               gamma1 = -m0 / (2 * kCotton.k0 * kCotton.k0);
  Driven<Law> cloth(law);
  const double mr = cloth.moment(kr);
  for (int i = 1; i <= 20; ++i) {
    const double x = 2 * kCotton.k0 * i / 20;
    EXPECT_NEAR(cloth.moment(kr - x), mr - (beta1 * x + gamma1 * x * x), tolerance);  // Wong, Eqs. 4.4, 4.5
  }
  EXPECT_NEAR(cloth.moment(kr - 3 * kCotton.k0), kCotton.b2 * (kr - 3 * kCotton.k0) - m0, tolerance);
  EXPECT_NEAR(beta1, kCotton.b1, kCurveRounding);
}

TEST(VirginCurve, IsDoubledAfterAReversalAsTheChapterPrints) {
  const double tolerance = kCurveRounding * kCotton.b2 * 4 * kCotton.k0;
  expect_doubled_branch(Wong<double>::make(kCotton), tolerance);
  expect_doubled_branch(PrandtlStack<double, 8>::make(kCotton), tolerance);
  // A branch over 2 K0 misses by twice the virgin error.
  expect_doubled_branch(PrandtlStops<double, 1, 32>::make(kCotton),
                        2 * kCotton.friction_moment() / (32 * 32));
}

template <class Law>
void expect_straight_line(const VirginCurve& c) {
  Driven cloth(Law::make(c));
  for (double k : {0.0, 10.0, -20.0, 5.0, 5.0, 0.0, -5.0}) {
    EXPECT_DOUBLE_EQ(cloth.moment(k), c.b2 * k);
    EXPECT_DOUBLE_EQ(cloth.law.tangent(Vec<double, 1>(k), cloth.history)(0, 0), c.b2);
    EXPECT_NEAR(cloth.last.dissipated, 0, 0);
    EXPECT_NEAR(cloth.law.residual(cloth.history)[0], 0, 1e-12);
  }
}

TEST(VirginCurve, WithoutFrictionEveryLawIsTheStraightLine) {
  for (const VirginCurve& c : {VirginCurve{1e-5, 1e-5, 50}, VirginCurve{3e-5, 1e-5, 0}}) {
    expect_straight_line<Linear<double, 1>>(c);
    expect_straight_line<Pabst<double, 1>>(c);
    expect_straight_line<PrandtlStops<double, 1, 8>>(c);
    expect_straight_line<PrandtlStack<double, 8>>(c);
  }
}

TEST(VirginCurve, BeginsWithTheInitialRigidityAsTangent) {
  const Vec<double, 1> rest(0.0);
  EXPECT_DOUBLE_EQ((Pabst<double, 1>::make(kCotton).tangent(rest, {})(0, 0)), kCotton.b1);
  EXPECT_DOUBLE_EQ((PrandtlStops<double, 1, 8>::make(kCotton).tangent(rest, {})(0, 0)), kCotton.b1);
  EXPECT_DOUBLE_EQ((PrandtlStack<double, 8>::make(kCotton).tangent(rest, {})(0, 0)), kCotton.b1);
  EXPECT_DOUBLE_EQ(Wong<double>::make(kCotton).tangent(rest, {})(0, 0), kCotton.b1);
}

// The quadratic branches run into the straight lines with the same moment and the same slope.
template <class Law>
void expect_smooth_joins(const Law& law) {
  constexpr double kStep = 1e-6;                                        // of K0
  const double bend = 4 * std::abs(kCotton.c1()) * kStep * kCotton.k0;  // change of slope over two steps
  for (const double turn : {0.0, 1.0, 2.5, 7.0}) {                      // in K0; 0: the virgin curve
    Driven<Law> cloth(law);
    if (turn > 0) cloth.moment(turn * kCotton.k0);
    const double join = turn > 0 ? turn - 2 : 1, sense = turn > 0 ? -1 : 1;
    const auto at = [&](double x) { return Vec<double, 1>((join + sense * x) * kCotton.k0); };
    const auto slope = [&](double x) { return law.tangent(at(x), cloth.history)(0, 0); };
    const auto moment = [&](double x) { return law.step(at(x), cloth.history).moment[0]; };
    EXPECT_NEAR(slope(-kStep), slope(kStep), bend) << "join at " << join << " K0";
    EXPECT_NEAR(moment(kStep) - moment(-kStep), sense * kCotton.b2 * 2 * kStep * kCotton.k0,
                2 * bend * kStep * kCotton.k0);
  }
}

TEST(VirginCurve, AndItsBranchesJoinTheStraightLinesWithoutAKink) {
  expect_smooth_joins(PrandtlStack<double, 8>::make(kCotton));
  expect_smooth_joins(Wong<double>::make(kCotton));
}

}  // namespace
}  // namespace hysteron::testing
