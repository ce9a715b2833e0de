// Fatigue: friction that weakens with what it dissipates, and the set that it leaves.
#include "sim/bending/laws/fatigue.h"

#include <gtest/gtest.h>

#include "sim/bending/laws/law_commands.h"
#include "sim/bending/laws/prandtl_stack.h"
#include "sim/bending/laws/prandtl_stops.h"
#include "sim/bending/laws/wong.h"
#include "tests/sim/bending/laws/law_fixtures.h"

namespace hysteron::testing {
namespace {

template <class Law>
Fatigue<Law> tired(const FatigueParams& choice) {
  return Fatigue<Law>::make(kCotton, choice, Law::make({kCotton.b1 - kCotton.b2, 0, kCotton.k0}));
}

using TiringStops = PrandtlStops<double, 1, 8>;

TEST(Fatigue, OfUnlimitedEnergyIsTheLawItself) {
  Driven<Fatigue<TiringStops>> tired_cloth(tired<TiringStops>({1e30, 0, 1}));
  Driven fresh(TiringStops::make(kCotton));
  for (double k : random_turns(200, 2 * kCotton.k0, 3)) {
    ASSERT_NEAR(tired_cloth.moment(k), fresh.moment(k), 1e-15);
    ASSERT_NEAR(tired_cloth.last.stored, fresh.last.stored, 1e-13);
    ASSERT_NEAR(tired_cloth.last.dissipated, fresh.last.dissipated, 1e-13);
  }
}

TEST(Fatigue, WeakensExponentiallyWithTheEnergyLost) {
  const double m0 = kCotton.friction_moment(), m_inf = 1e-4, dc = 0.3;
  Driven<Fatigue<TiringStops>> cloth(tired<TiringStops>({dc, m_inf, 0}));
  constexpr double kTwoRounds = 1e-4;  // (M0 K0/3 / Dc)^2 of the energy that weakening itself releases
  double at = 0;
  for (int cycle = 0; cycle < 4; ++cycle)
    for (double k : {100., -100.}) {
      for (int i = 1; i <= 100; ++i) cloth.moment(at + (k - at) * i / 100);
      at = k;
      EXPECT_NEAR(cloth.law.strength(cloth.history),
                  (m_inf + (m0 - m_inf) * std::exp(-cloth.dissipated / dc)) / m0, kTwoRounds);
    }
  EXPECT_LT(cloth.law.strength(cloth.history), 0.5);
}

TEST(Fatigue, SetStaysWithinTheFrictionMomentLostOverTheRigidity) {
  for (double eta : {0.3, 1.0}) {
    Driven<Fatigue<TiringStops>> cloth(tired<TiringStops>({0.05, 1e-4, eta}));
    const double bound = eta * (kCotton.friction_moment() - 1e-4) / kCotton.b2;
    double largest = 0;
    for (double k : random_turns(3000, 4 * kCotton.k0, 4)) {
      cloth.moment(std::abs(k));  // always to one side, as a fold is
      const double set = std::abs(Fatigue<TiringStops>::set_curvature(cloth.history)[0]);
      ASSERT_LE(set, bound * (1 + 1e-12));
      largest = std::max(largest, set);
    }
    EXPECT_GT(largest, 0.1 * bound);
  }
}

// The loss in a cycle falls with the strength m itself, so that m falls as 1/cycles.
TEST(Fatigue, EndsAsAnElasticSheetWithAPermanentCrease) {
  Driven<Fatigue<TiringStops>> cloth(tired<TiringStops>({0.05, 0, 1}));
  double strength_after_half = 0;
  constexpr int kCycles = 4000;
  for (int cycle = 0; cycle < kCycles; ++cycle) {  // folded to 200/m and let go
    for (double k : {200., cloth.law.residual(cloth.history)[0]}) cloth.moment(k);
    if (cycle == kCycles / 2) strength_after_half = cloth.law.strength(cloth.history);
  }
  const double set = Fatigue<TiringStops>::set_curvature(cloth.history)[0],
               left = cloth.law.strength(cloth.history);
  EXPECT_NEAR(strength_after_half / left, 2, 0.1);
  EXPECT_LT(left, 1e-3);
  EXPECT_GT(set, 1);  // [1/m]
  for (double k : {-100., 60., 200.})
    EXPECT_NEAR(cloth.moment(k), kCotton.b2 * (k - set), 1.01 * left * kCotton.friction_moment());
}

TEST(Fatigue, KeepsTheMomentOfAHeldFoldWhileItSets) {
  // eta = 1: what friction loses, the set takes over, as long as friction holds the fold open.
  Driven<Fatigue<TiringStops>> cloth(tired<TiringStops>({0.2, 0, 1}));
  cloth.moment(200);
  const double rest = cloth.law.residual(cloth.history)[0];
  cloth.moment(rest);
  const double strength = cloth.law.strength(cloth.history);
  for (int i = 0; i < 40; ++i)
    for (double ripple : {0.5, -0.5, 0.}) cloth.moment(rest + ripple);
  EXPECT_LT(cloth.law.strength(cloth.history), strength);
  constexpr double kStopsRub = 0.05;  // ripples of 0.5/m in stops of 3 to 47/m: the shortest slips a little
  EXPECT_NEAR(cloth.law.residual(cloth.history)[0], rest, kStopsRub * kCotton.k0);
}

TEST(Fatigue, IsHealedByIroningButStaysWeak) {
  Driven<Fatigue<TiringStops>> cloth(tired<TiringStops>({0.1, 0, 1}));
  for (int i = 0; i < 20; ++i)
    for (double k : {200., 20.}) cloth.moment(k);
  const double strength = cloth.law.strength(cloth.history);
  ASSERT_GT(Fatigue<TiringStops>::set_curvature(cloth.history)[0], 1);
  const auto flat = ironed(cloth.law, Vec<double, 1>(0.), cloth.history);
  EXPECT_EQ(Fatigue<TiringStops>::set_curvature(flat)[0], 0);
  EXPECT_EQ(cloth.law.step(Vec<double, 1>(0.), flat).moment[0], 0);
  EXPECT_NEAR(cloth.law.strength(flat), strength, 1e-15);
}

}  // namespace
}  // namespace hysteron::testing
