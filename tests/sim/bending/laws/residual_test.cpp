// Residual curvature: where the moment vanishes on the way back (Wong 4.3.3, after Anandjiwala & Leaf 1991).
#include <gtest/gtest.h>

#include <random>

#include "sim/bending/laws/beside_elasticity.h"
#include "sim/bending/laws/linear.h"
#include "sim/bending/laws/pabst.h"
#include "sim/bending/laws/prandtl_stack.h"
#include "sim/bending/laws/prandtl_stops.h"
#include "sim/bending/laws/wong.h"
#include "tests/sim/bending/laws/law_fixtures.h"

namespace hysteron::testing {
namespace {

constexpr double kResidualRounding = 1e-11;  // of K0

template <class Law>
double residual_after(const Law& law, double curvature) {
  Driven<Law> cloth(law);
  cloth.moment(curvature);
  return law.residual(cloth.history)[0];
}

// Root of b2 K + F = 0 on the doubled branch that begins at (km, f m): F = f - (g x - g x^2/(4 K0)), x = km -
// K.
double root_on_quadratic(const VirginCurve& c, double km, double friction) {
  const double q = (c.b1 - c.b2) / (4 * c.k0), m = c.b2 * km + friction;
  return km - (c.b1 - std::sqrt(c.b1 * c.b1 - 4 * q * m)) / (2 * q);
}

template <class Law>
void expect_three_cases(const Law& law) {
  const double m0 = kCotton.friction_moment(), last = m0 / kCotton.b2;  // HB/B
  for (double km : {0.3 * kCotton.k0, 0.7 * kCotton.k0, kCotton.k0})    // case 1, |M| <= Ma
    EXPECT_GT(residual_after(law, km), 0);    // the chapter's bilinear argument gives 0
  const double km = last + 1.2 * kCotton.k0;  // case 2: the root is on the quadratic
  EXPECT_NEAR(residual_after(law, km), root_on_quadratic(kCotton, km, m0), kResidualRounding * kCotton.k0);
  for (double far : {last + 2 * kCotton.k0, last + 5 * kCotton.k0, 1000.0})  // case 3: M0/b2
    EXPECT_NEAR(residual_after(law, far), last, kResidualRounding * kCotton.k0);
  EXPECT_NEAR(residual_after(law, -1000.0), -last, kResidualRounding * kCotton.k0);
}

TEST(Residual, FollowsTheThreeCasesOfRecovery) {
  expect_three_cases(PrandtlStack<double, 8>::make(kCotton));
  expect_three_cases(Wong<double>::make(kCotton));
}

TEST(Residual, OfPrandtlInTheFirstCaseIsTheRootOnTheDoubledBranch) {
  const auto law = PrandtlStack<double, 8>::make(kCotton);
  for (double u : {0.1, 0.3, 0.7, 1.0}) {
    const double friction = kCotton.friction_moment() * (2 * u - u * u), km = u * kCotton.k0;
    EXPECT_NEAR(residual_after(law, km), root_on_quadratic(kCotton, km, friction),
                kResidualRounding * kCotton.k0);
  }
}

TEST(Residual, OfCottonBroadAtTheElasticLimitIsAQuarterOfIt) {
  constexpr double kTwoDigits = 0.005;
  EXPECT_NEAR(residual_after(PrandtlStack<double, 8>::make(kCotton), kCotton.k0) / kCotton.k0, 0.24,
              kTwoDigits);
}

TEST(Residual, AtTheElasticLimitApproachesSqrtTwoMinusOneWithoutElasticity) {
  const VirginCurve frictional{1e-5, 1e-12, 50};  // b2 << b1
  constexpr double kRatio = 1e-6;                 // b2/b1 = 1e-7
  EXPECT_NEAR(residual_after(PrandtlStack<double, 8>::make(frictional), 50) / 50, std::sqrt(2) - 1, kRatio);
}

TEST(Residual, IsZeroForReversibleRecoveryUpToTheElasticLimitOnly) {
  const auto law = Wong<double>::make(kCotton, Recovery::kReversible);
  EXPECT_EQ(residual_after(law, 0.9 * kCotton.k0), 0);
  EXPECT_EQ(residual_after(law, -0.9 * kCotton.k0), 0);
  EXPECT_GT(residual_after(law, 1.1 * kCotton.k0), 0.1 * kCotton.k0);
}

TEST(Residual, IsZeroWithoutMemoryAndOnVirginCloth) {
  EXPECT_EQ(residual_after(Linear<double, 1>::make(kCotton), 100), 0);
  EXPECT_EQ(residual_after(Pabst<double, 1>::make(kCotton), 100), 0);
  EXPECT_EQ((PrandtlStack<double, 8>::make(kCotton).residual({})[0]), 0);
  EXPECT_EQ(Wong<double>::make(kCotton).residual({})[0], 0);
  EXPECT_EQ((PrandtlStops<double, 3, 8>::make(kCotton).residual({}).norm()), 0);
}

TEST(Residual, OfStopsInTheThirdCaseIsTheFrictionMomentOverTheRigidity) {
  EXPECT_NEAR(residual_after(PrandtlStops<double, 1, 8>::make(kCotton), 400),
              kCotton.friction_moment() / kCotton.b2, kResidualRounding * kCotton.k0);
}

// EveryLaw.CarriesNoMomentAtItsResidualCurvature goes there in all others.
TEST(Residual, CarriesNoMomentWhereAStackIsFull) {
  constexpr double kSolved = 1e-10;  // of b1 K0
  Driven cloth(PrandtlStack<double, 4>::make(kCotton));
  for (double k : random_turns(300, 3 * kCotton.k0, 21)) {
    cloth.moment(k);
    const auto there = cloth.law.step(cloth.law.residual(cloth.history), cloth.history);
    ASSERT_LE(there.moment.norm(), kSolved * kCotton.b1 * kCotton.k0);
  }
}

// Elasticity beside the law leaves from a tenth of b2 to ten times it, as friction of its own along weft
// does.
template <class Law>
void expect_no_moment_beside_elasticity(const Law& law) {
  constexpr double kSolved = 1e-9;  // of M0
  std::mt19937 generator(5);
  std::uniform_real_distribution<double> decade(-1, 1);
  for (int history = 0; history < 500; ++history) {
    Driven cloth(law);
    const double span = kCotton.k0 * 3 * std::pow(10, decade(generator));
    for (int turn = 0; turn <= history % 12; ++turn) {
      CurvatureOf<Law> curvature;
      for (double& k : curvature) k = span * decade(generator);
      cloth.to(curvature);
    }
    CurvatureOf<Law> elastic;
    for (double& e : elastic) e = kCotton.b2 * (std::pow(10, decade(generator)) - 1);
    const CurvatureOf<Law> rest = beside_elasticity(law, elastic, cloth.history);
    const CurvatureOf<Law> moment = law.step(rest, cloth.history).moment + elastic.cwiseProduct(rest);
    ASSERT_LE(moment.norm(), kSolved * kCotton.friction_moment()) << "history " << history;
  }
}

TEST(Residual, CarriesNoMomentBesideElasticityOfADirection) {
  expect_no_moment_beside_elasticity(PrandtlStack<double, 8>::make(kCotton));
  expect_no_moment_beside_elasticity(Wong<double>::make(kCotton));
  expect_no_moment_beside_elasticity(PrandtlStops<double, 3, 8>::make(kCotton));
}

}  // namespace
}  // namespace hysteron::testing
