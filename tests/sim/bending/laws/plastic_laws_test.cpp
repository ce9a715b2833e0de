// Closed forms of the laws that flow: plastic, creeping, ageing, relaxing.
#include <gtest/gtest.h>

#include "sim/bending/laws/dahl.h"
#include "sim/bending/laws/gong.h"
#include "sim/bending/laws/grinspun_edit.h"
#include "sim/bending/laws/kim.h"
#include "sim/bending/laws/narain.h"
#include "sim/bending/laws/obrien.h"
#include "sim/bending/laws/terzopoulos.h"
#include "tests/sim/bending/laws/law_fixtures.h"

namespace hysteron::testing {
namespace {

constexpr double kNone = std::numeric_limits<double>::infinity();
constexpr double kPlasticRounding = 1e-14;  // of moments of about 1e-3 N

TEST(Obrien, YieldsAtItsThresholdAndUnloadsElastically) {
  Driven cloth(Obrien<double, 1>::make(kCotton, 40, kNone));
  EXPECT_NEAR(cloth.moment(30), kCotton.b2 * 30, kPlasticRounding);
  EXPECT_NEAR(cloth.moment(100), kCotton.b2 * 40, kPlasticRounding);  // K_p = 60
  EXPECT_NEAR(cloth.moment(60), 0, kPlasticRounding);
  EXPECT_NEAR(cloth.moment(-20), -kCotton.b2 * 40, kPlasticRounding);  // K_p = 20
  EXPECT_NEAR(cloth.dissipated, kCotton.b2 * 40 * (60 + 40), kPlasticRounding);
}

TEST(Obrien, LoopAreaIsThatOfAnElasticPerfectlyPlasticPlate) {
  Driven cloth(Obrien<double, 1>::make(kCotton, 40, kNone));
  EXPECT_NEAR(cloth.cycle_loss(100), 4 * kCotton.b2 * 40 * (100 - 40), 1e-12);
}

TEST(Obrien, IsElasticAgainWhereItsSetIsBounded) {
  Driven cloth(Obrien<double, 1>::make(kCotton, 40, 25));
  EXPECT_NEAR(cloth.moment(100), kCotton.b2 * (100 - 25), kPlasticRounding);
  EXPECT_NEAR(cloth.dissipated, kCotton.b2 * 40 * 25, kPlasticRounding);
  EXPECT_NEAR(cloth.moment(-100), -kCotton.b2 * (100 - 25), kPlasticRounding);
  EXPECT_NEAR(cloth.dissipated, kCotton.b2 * 40 * (25 + 50), kPlasticRounding);
}

TEST(Narain, WeakensByOneOverOnePlusDamageAfterTheStepThatYields) {
  Driven cloth(Narain<double, 1>::make(kCotton, 40, kNone, 2));
  EXPECT_NEAR(cloth.moment(100), kCotton.b2 * 40, kPlasticRounding);
  const double softened = kCotton.b2 / (1 + 2 * (100. / 40 - 1));
  EXPECT_NEAR(cloth.moment(90), softened * 30, kPlasticRounding);
  EXPECT_NEAR(cloth.moment(60), 0, kPlasticRounding);
  EXPECT_NEAR(cloth.dissipated, kCotton.b2 * 40 * 60 + (kCotton.b2 - softened) * 40 * 40 / 2,
              kPlasticRounding);
}

TEST(Narain, WithoutWeakeningIsObrien) {
  Driven narain(Narain<double, 3>::make(kCotton, 40, 30, 0));
  Driven obrien(Obrien<double, 3>::make(kCotton, 40, 30));
  for (const auto& k : random_tensors(100, 100, 3))
    ASSERT_LE((narain.to(k).moment - obrien.to(k).moment).norm(), kPlasticRounding);
  EXPECT_NEAR(narain.dissipated, obrien.dissipated, 100 * kPlasticRounding);
}

TEST(Terzopoulos, CreepsDownToTheFrictionMomentExponentially) {
  auto law = Terzopoulos<double, 1>::make(kCotton, 2.0);
  const double start = kCotton.b2 * 200, m0 = kCotton.friction_moment();
  for (int steps : {1, 7, 400}) {  // in any number of steps: the decay is exact
    law.dt = 3.0 / steps;
    Driven<Terzopoulos<double, 1>> cloth(law);
    for (int i = 0; i < steps; ++i) cloth.moment(200);
    EXPECT_NEAR(cloth.last.moment[0], m0 + (start - m0) * std::exp(-3.0 / 2.0), 1e-12);
  }
  law.dt = 1e9;
  Driven<Terzopoulos<double, 1>> slow(law);
  EXPECT_NEAR(slow.moment(200), m0, kPlasticRounding);
  EXPECT_NEAR(slow.law.residual(slow.history)[0], 200 - m0 / kCotton.b2, 1e-10);
}

TEST(Kim, CreepsToItsThresholdAndSoftensByTheWayOfItsSet) {
  auto law = Kim<double, 1>::make(kCotton, 40, kNone, 0.5, 2.0);
  law.dt = 1;
  Driven<Kim<double, 1>> cloth(law);
  const double held = 200 * std::exp(-0.5);
  EXPECT_NEAR(cloth.moment(200), kCotton.b2 * held, kPlasticRounding);
  const double softened = kCotton.b2 / (1 + 0.5 * (200 - held) / 40);
  EXPECT_NEAR(cloth.moment(200), softened * held * std::exp(-0.5), kPlasticRounding);
  for (int i = 0; i < 60; ++i) cloth.moment(200);
  EXPECT_NEAR(cloth.law.residual(cloth.history)[0], 200 - 40, 1e-10);
}

TEST(Kim, StopsCreepingAtTheBoundOfItsSet) {
  auto law = Kim<double, 1>::make(kCotton, 40, 25, 1, 1);
  law.dt = 100;
  Driven<Kim<double, 1>> cloth(law);
  cloth.moment(200);
  EXPECT_NEAR(cloth.law.residual(cloth.history)[0], 25, 1e-12);
  cloth.moment(-200);
  EXPECT_NEAR(cloth.law.residual(cloth.history)[0], -25, 1e-12);
}

TEST(GrinspunEdit, HasNoMomentWhereItWasEditedAndForgetsNothingElse) {
  const auto law = GrinspunEdit<double, 3>::make(kCotton);
  const Vec<double, 3> bent(100, -20, 7);
  const auto edited = law.edited(bent, {});
  EXPECT_EQ(law.step(bent, edited).moment.norm(), 0);
  EXPECT_NEAR((law.step(Vec<double, 3>::Zero(), edited).moment + kCotton.b2 * bent).norm(), 0,
              kPlasticRounding);
}

TEST(Dahl, RelaxesExponentiallyToTheFrictionMoment) {
  const double m0 = kCotton.friction_moment(), l = kCotton.k0 / 2;
  Driven cloth(Dahl<double, 1>::make(kCotton));
  const double f1 = m0 * (1 - std::exp(-60 / l));
  EXPECT_NEAR(cloth.moment(60), kCotton.b2 * 60 + f1, kPlasticRounding);
  const double f2 = -m0 + (f1 + m0) * std::exp(-100 / l);
  EXPECT_NEAR(cloth.moment(-40), -kCotton.b2 * 40 + f2, kPlasticRounding);
  EXPECT_NEAR(cloth.last.stored, kCotton.b2 * 40 * 40 / 2 + f2 * f2 / (2 * (kCotton.b1 - kCotton.b2)),
              kPlasticRounding);
}

TEST(Dahl, AStepInOnePieceEqualsManySmallOnes) {
  Driven one(Dahl<double, 1>::make(kCotton)), many(one.law);
  double at = 0;
  for (double k : random_turns(30, 2 * kCotton.k0, 9)) {
    for (int i = 1; i <= 20; ++i) many.moment(at + (k - at) * i / 20);
    ASSERT_NEAR(one.moment(k), many.last.moment[0], 1e-13);
    at = k;
  }
  EXPECT_NEAR(one.dissipated, many.dissipated, 1e-12);
}

// In a settled cycle of +-A the friction F reaches +-F_A with F_A = M0 tanh(A/l), and loses 4 (M0 A - l F_A).
TEST(Dahl, LoopAreaMatchesClosedForm) {
  const double m0 = kCotton.friction_moment(), l = kCotton.k0 / 2;
  for (double amplitude : {10., 50., 200.}) {
    Driven cloth(Dahl<double, 1>::make(kCotton));
    const double settled = m0 * std::tanh(amplitude / l);
    EXPECT_NEAR(cloth.cycle_loss(amplitude, 200), 4 * (m0 * amplitude - l * settled), 1e-12);
    EXPECT_NEAR(cloth.last.moment[0], -kCotton.b2 * amplitude - settled, 1e-12);
  }
}

TEST(Gong, HoldsTheFullFrictionMomentOnlyAfterALongHold) {
  auto law = Gong<double>::make(kCotton, 1e6, 30);  // yields nowhere: friction alone
  const double m0 = kCotton.friction_moment();
  law.dt = 0;
  EXPECT_NEAR((law.step(Vec<double, 1>(100.), {}).moment[0] - kCotton.b2 * 100), m0 / 12, kPlasticRounding);
  law.dt = 1e9;
  EXPECT_NEAR((law.step(Vec<double, 1>(100.), {}).moment[0] - kCotton.b2 * 100), m0, kPlasticRounding);
}

// Below yield the anchor alone keeps a bend.  One that slipped through bending and was let go at once slips
// back to g r_0/b2; after a hold friction holds the anchor where it is, and b2 K + g (K - anchor) = 0.
TEST(Gong, AHoldStrengthensTheFrictionThatTheReleaseMeets) {
  const double g = kCotton.b1 - kCotton.b2, first = kCotton.k0 / 2 / 12, bent = 40;
  const auto residual_after = [&](double held) {
    Driven cloth(Gong<double>::make(kCotton, kCotton.k0, 30));
    cloth.law.dt = 1e-3;
    for (int i = 1; i <= 400; ++i) cloth.moment(bent * i / 400);
    for (int i = 0; i < 10; ++i) {
      cloth.law.dt = held / 10;
      cloth.moment(bent);
    }
    cloth.law.dt = 1e-3;
    return cloth.law.residual(cloth.history)[0];
  };
  constexpr double kOfTheClock = 0.02;  // thresholds grow by 0.03 % in a step of 1 ms
  EXPECT_NEAR(residual_after(0), g * first / kCotton.b2, kOfTheClock);  // 4.4/m
  for (double held : {30., 600.})
    EXPECT_NEAR(residual_after(held), g / (g + kCotton.b2) * (bent - first), kOfTheClock) << held;  // 25.7/m
}

// ... and turning back leaves it as strong as it was, until the anchor slips.
TEST(Gong, KeepsItsFrictionThroughAReversal) {
  auto law = Gong<double>::make(kCotton, 1e6, 30);
  law.dt = 1e9;
  Driven<Gong<double>> cloth(law);
  cloth.moment(1);  // stuck, for long
  cloth.law.dt = 0;
  const double m0 = kCotton.friction_moment();
  cloth.moment(20);  // 20 < r_inf = 25
  EXPECT_NEAR(cloth.moment(-20) + kCotton.b2 * 20, -(kCotton.b1 - kCotton.b2) * 20, kPlasticRounding);
  EXPECT_NEAR(cloth.moment(-100) + kCotton.b2 * 100, -m0, kPlasticRounding);
  EXPECT_NEAR(cloth.moment(-101) + kCotton.b2 * 101, -m0 / 12, kPlasticRounding) << "after it has slipped";
}

TEST(Gong, HardensIsotropicallyAtFirstContactWithFiveSixthsOfTheExcessKept) {
  VirginCurve c = kCotton;
  c.b1 = c.b2;  // plasticity alone
  auto law = Gong<double>::make(c, 40, 30);
  Driven<Gong<double>> cloth(law);
  EXPECT_NEAR(cloth.moment(100), c.b2 * (40 + 60 * 5. / 6), kPlasticRounding);  // k_h = 5 b2
  EXPECT_NEAR(cloth.law.residual(cloth.history)[0], 10, 1e-9);
  EXPECT_NEAR(cloth.moment(10 + 89), c.b2 * 89, kPlasticRounding);   // below the new threshold of 90
  EXPECT_NEAR(cloth.moment(10 - 89), -c.b2 * 89, kPlasticRounding);  // on both sides
}

TEST(Gong, SetsMoreTheLongerItIsHeld) {
  VirginCurve c = kCotton;
  c.b1 = c.b2;  // plasticity alone
  double before = 0;
  for (double held : {0., 10., 100., 1000.}) {
    auto law = Gong<double>::make(c, 40, 30);
    law.dt = held;
    Driven<Gong<double>> cloth(law);
    cloth.moment(200);
    const double set = cloth.law.residual(cloth.history)[0];
    EXPECT_GT(set, before);
    before = set;
  }
}

}  // namespace
}  // namespace hysteron::testing
