// `wong`: equal to `prandtl` on large cycles, its loops, its reversible recovery, and where it fails.
#include "sim/bending/laws/wong.h"

#include <gtest/gtest.h>

#include "sim/bending/laws/prandtl_stack.h"
#include "tests/sim/bending/laws/law_fixtures.h"

namespace hysteron::testing {
namespace {

TEST(Wong, EqualsPrandtlOnCyclesOfAmplitudeAboveTheElasticLimit) {
  constexpr double kRounding = 1e-12;  // of the largest moment
  for (double amplitude : {1.0, 1.3, 2.0, 5.0}) {
    Driven wong(Wong<double>::make(kCotton));
    Driven prandtl(PrandtlStack<double, 8>::make(kCotton));
    for (int i = 0; i <= 400; ++i) {
      const int phase = i % 80;  // four corners per cycle of 80 steps, from rest
      const double wave = phase <= 20 ? phase / 20. : phase <= 60 ? 2 - phase / 20. : phase / 20. - 4;
      const double k = amplitude * kCotton.k0 * wave;
      ASSERT_NEAR(wong.moment(k), prandtl.moment(k),
                  kRounding * (kCotton.friction_moment() + kCotton.b2 * amplitude * kCotton.k0));
    }
  }
}

double settled_loop_area(double amplitude) {
  constexpr int kCyclesToSettle = 2000;
  return Driven(Wong<double>::make(kCotton)).cycle_loss(amplitude, kCyclesToSettle);
}

TEST(Wong, LoopAreaMatchesClosedFormBelowTheElasticLimit) {
  constexpr double kSettled = 1e-12;
  for (double a : {0.1, 0.3, 0.6, 0.9}) {
    const double amplitude = a * kCotton.k0, x = (2 * a - 1 + std::sqrt(1 + 4 * a - 4 * a * a)) / 2;
    const double area = 8. / 3 * -kCotton.c1() * amplitude * amplitude * amplitude / (1 + x);
    EXPECT_NEAR(settled_loop_area(amplitude), area, kSettled * kCotton.friction_moment() * kCotton.k0)
        << "a = " << a;
  }
}

TEST(Wong, LoopAreaMatchesClosedFormAboveTheElasticLimit) {
  constexpr double kRounding = 1e-10;  // a difference of sums over 2000 cycles
  for (double a : {1.0, 1.5, 4.0})
    EXPECT_NEAR(settled_loop_area(a * kCotton.k0), 4 * kCotton.friction_moment() * kCotton.k0 * (a - 2. / 3),
                kRounding * kCotton.friction_moment() * kCotton.k0);
}

// Moves in `direction` until friction reaches `target` (in M0); bisection over the law itself.
void move_until_friction(Driven<Wong<double>>& cloth, double& k, double direction, double target) {
  const auto friction = [&](double at) {
    return (cloth.law.step(Vec<double, 1>(at), cloth.history).moment[0] - kCotton.b2 * at) /
           kCotton.friction_moment();
  };
  double near = 0, far = 2 * kCotton.k0;
  for (int i = 0; i < 100; ++i) {
    const double middle = (near + far) / 2;
    (direction * (friction(k + direction * middle) - target) < 0 ? near : far) = middle;
  }
  k += direction * far;
  cloth.moment(k);
}

TEST(Wong, ReturnsMoreThanWasSpentInTheRippleOfTwentyTwoReversals) {
  constexpr double kRipple[] = {-.3,    -.2875, -.3875, -.375, -.4625, -.45,  -.525,  -.5125,
                                -.5875, -.575,  -.6375, -.625, -.6875, -.675, -.7375, -.725,
                                -.775,  -.7625, -.8125, -.025, -.1875, -.175, -.3};  // F/M0 at the reversals
  Driven cloth(Wong<double>::make(kCotton));
  double k = 0, direction = -1;
  move_until_friction(cloth, k, direction, kRipple[0]);
  const double before = cloth.dissipated;
  for (int i = 1; i < 23; ++i) {
    direction = -direction;
    move_until_friction(cloth, k, direction, kRipple[i]);
  }
  // Friction is back at its value and ready to turn up again: the ripple can be repeated for ever.
  constexpr double kPublished = 0.0059, kItsRounding = 0.00005;
  EXPECT_NEAR((before - cloth.dissipated) / (kCotton.friction_moment() * kCotton.k0), kPublished,
              kItsRounding);
}

TEST(Wong, ReversibleRecoveryComesBackToAVirginOrigin) {
  Driven cloth(Wong<double>::make(kCotton, Recovery::kReversible)), fresh(cloth.law);
  const double kr = 0.8 * kCotton.k0, mr = cloth.moment(kr);
  constexpr double kRounding = 1e-14;
  for (double k = 0.7 * kCotton.k0; k > 0; k -= 0.1 * kCotton.k0)
    EXPECT_NEAR(cloth.moment(k), mr + kCotton.b1 * (k - kr) - kCotton.c1() * (k - kr) * (k - kr), kRounding);
  EXPECT_NEAR(cloth.moment(0), 0, kRounding);
  EXPECT_NEAR(cloth.dissipated, -kCotton.c1() * kr * kr * kr / 3, kRounding);  // zero residual, not zero loss
  for (double k : {-0.5, -2.0, 0.3})
    EXPECT_NEAR(cloth.moment(k * kCotton.k0), fresh.moment(k * kCotton.k0), kRounding);
}

TEST(Wong, ReversibleRecoveryGoesStraightThroughTheOrigin) {
  Driven cloth(Wong<double>::make(kCotton, Recovery::kReversible)), fresh(cloth.law);
  cloth.moment(0.6 * kCotton.k0);
  EXPECT_DOUBLE_EQ(cloth.moment(-0.4 * kCotton.k0), fresh.moment(-0.4 * kCotton.k0));
}

TEST(Wong, ReversibleRecoveryAppliesOnlyUpToTheElasticLimit) {
  Driven reversible(Wong<double>::make(kCotton, Recovery::kReversible));
  Driven masing(Wong<double>::make(kCotton));
  for (double k : {1.01, 0.4, 0.7, -0.2})
    EXPECT_DOUBLE_EQ(reversible.moment(k * kCotton.k0), masing.moment(k * kCotton.k0));
}

TEST(Wong, ReversalOnTheReversibleRecoveryStartsABranchWithTheInitialSlope) {
  Driven cloth(Wong<double>::make(kCotton, Recovery::kReversible));
  cloth.moment(0.8 * kCotton.k0);
  const double turn = 0.3 * kCotton.k0, mr = cloth.moment(turn), fr = mr - kCotton.b2 * turn,
               m0 = kCotton.friction_moment();
  const double span = 2 * (m0 - fr) / (kCotton.b1 - kCotton.b2), u = 0.2 * kCotton.k0 / span;
  constexpr double kRounding = 1e-15;
  EXPECT_NEAR(cloth.moment(0.5 * kCotton.k0),
              kCotton.b2 * 0.5 * kCotton.k0 + m0 - (m0 - fr) * (1 - u) * (1 - u), kRounding);
}

// F at each turn from F at the one before, written out once more from the header's formula.
std::vector<double> friction_at_turns(const VirginCurve& c, const std::vector<double>& turns) {
  const double g = c.b1 - c.b2, m0 = c.friction_moment();
  std::vector<double> result;
  double at = 0, turned_at = 0, turned_with = 0, friction = 0, side = 0;
  for (double k : turns) {
    const double s = k > at ? 1 : -1;
    if (s != side && side != 0) turned_at = at, turned_with = friction;
    side = s;
    const double reach = 2 * (m0 - s * turned_with) / g, u = reach > 0 ? std::abs(k - turned_at) / reach : 1;
    friction = u < 1 ? s * m0 - (s * m0 - turned_with) * (1 - u) * (1 - u) : s * m0;
    result.push_back(friction);
    at = k;
  }
  return result;
}

TEST(Wong, EqualsItsFormulaOnAThousandRandomHistories) {
  constexpr double kRounding = 1e-15;  // of moments of about 1e-3 N, over 60 reversals
  for (unsigned seed = 1; seed <= 1000; ++seed) {
    const std::vector<double> turns = random_turns(60, 2 * kCotton.k0, seed);
    const std::vector<double> friction = friction_at_turns(kCotton, turns);
    Driven cloth(Wong<double>::make(kCotton));
    for (size_t i = 0; i < turns.size(); ++i)
      ASSERT_NEAR(cloth.moment(turns[i]), kCotton.b2 * turns[i] + friction[i], 60 * kRounding);
  }
}

}  // namespace
}  // namespace hysteron::testing
