// Relaxing branches by closed form: relaxation at constant curvature, recovery after release, with and
// without friction.
#include <gtest/gtest.h>

#include "sim/bending/laws/chapman.h"
#include "sim/bending/laws/law_visit.h"
#include "tests/sim/bending/laws/law_fixtures.h"

namespace hysteron::testing {
namespace {

constexpr double kB = 1e-5, kC = 6e-6;   // elasticity and branch [N m]
constexpr double kTau = 20, kHold = 30;  // [s]
constexpr double kK1 = 200;              // of the fold [1/m]
constexpr double kTenthPercent = 1e-3;

using Stops = SpectrumStops<double, 1, 8>;
using Law = Relaxing<Stops, kMaxBranches>;

Law law(const Spectrum& friction = {}, const RelaxingBranches& branches = {{kTau}, {kC}}) {
  return Law::make(Stops::make(kB, friction, {}), branches);
}

// Friction of moment m0 that slips at once.
Spectrum couple(double m0) {
  constexpr double kThin = 1e-4;  // [1/m]
  return {{kThin}, {m0 / kThin}};
}

void hold(Driven<Law>& cloth, double curvature, double seconds) {
  cloth.law.dt = seconds;
  cloth.moment(curvature);
}

// The step to where no moment is left, of this length [s]; the moment grows with curvature.
double let_go(Driven<Law>& cloth, double seconds) {
  cloth.law.dt = seconds;
  double low = -2 * kK1, high = 2 * kK1;
  for (int halving = 0; halving < 60; ++halving) {
    const double middle = (low + high) / 2;
    const bool above = cloth.law.step(Vec<double, 1>(middle), cloth.history).moment[0] > 0;
    (above ? high : low) = middle;
  }
  cloth.moment(low);
  return low;
}

// Steps that grow with time: the first a thousandth of tau.
template <class Expected>
void expect_recovery(Driven<Law>& cloth, const Expected& expected) {
  EXPECT_NEAR(let_go(cloth, 0), expected(0), kTenthPercent * expected(0));
  double time = 0;
  for (double step = 1e-3 * kTau; time < 10 * kTau; step *= 1.05) {
    step = std::min(step, 0.05 * kTau);
    time += step;
    const double k = let_go(cloth, step);
    ASSERT_NEAR(k, expected(time), kTenthPercent * expected(time)) << time;
  }
}

TEST(Chapman, RelaxesAtConstantCurvatureToTheElasticMomentInStepsOfAnyLength) {
  const RelaxingBranches two{{2, 300}, {kC, kC / 3}};
  for (double step : {0.01, 1.0, 50.0}) {
    Driven<Law> cloth(law({}, two));
    hold(cloth, kK1, 0);
    for (int i = 1; i <= 12; ++i) {
      hold(cloth, kK1, step);
      const double t = i * step;
      const double expected = kK1 * (kB + kC * std::exp(-t / 2) + kC / 3 * std::exp(-t / 300));
      EXPECT_NEAR(cloth.last.moment[0], expected, 1e-13 * expected) << t;
    }
  }
}

// m = c tau K' (1 - exp(-t/tau)) in a bend at a constant rate K', however the time is divided.
TEST(Chapman, BendsAtAConstantRateExactlyInStepsOfAnyLength) {
  const double rate = 3, end = 47;
  for (int steps : {1, 7, 1000}) {
    Driven<Law> cloth(law());
    for (int i = 1; i <= steps; ++i) hold(cloth, rate * end * i / steps, end / steps);
    const double m = kC * kTau * rate * (1 - std::exp(-end / kTau));
    EXPECT_NEAR(cloth.last.moment[0], kB * rate * end + m, 1e-12 * kB * rate * end);
    // Work of that moment less what the spring has kept.
    const double work = kC * kTau * rate * rate * (end - kTau * (1 - std::exp(-end / kTau)));
    EXPECT_NEAR(cloth.dissipated, work - m * m / (2 * kC), 1e-11 * work);
  }
}

TEST(Chapman, LosesWhatItsSpringHeldWhileItRelaxes) {
  Driven<Law> cloth(law());
  hold(cloth, kK1, 0);
  const double spring = kC * kK1 * kK1 / 2;
  EXPECT_EQ(cloth.dissipated, 0);
  for (double step : {1e-9, 1e-4, 1.0, 1e4}) {
    const double before = cloth.last.stored;
    hold(cloth, kK1, step);
    EXPECT_NEAR(cloth.last.relaxed, before - cloth.last.stored, 1e-13 * spring);
    EXPECT_EQ(cloth.last.relaxed, cloth.last.dissipated);
  }
  EXPECT_NEAR(cloth.dissipated, spring, 1e-12 * spring);
}

// K(0+) = K1 c (1 - exp(-T/tau))/(b + c), then exp(-t b/((b + c) tau)).
TEST(Chapman, RecoversFromAFoldWithoutFriction) {
  Driven<Law> cloth(law());
  hold(cloth, kK1, 0);
  hold(cloth, kK1, kHold);
  const double first = kK1 * kC * (1 - std::exp(-kHold / kTau)) / (kB + kC);
  expect_recovery(cloth, [&](double t) { return first * std::exp(-t * kB / ((kB + kC) * kTau)); });
}

// There is a frictional couple M0: b K + m = M0 while it opens, K(0+) = (M0 + c K1 (1 - exp(-T/tau)))/(b +
// c), and K - M0/b decays at the same rate.
TEST(Chapman, RecoversFromAFoldDownToWhatFrictionHolds) {
  const double m0 = 2e-4, stop = m0 / kB;
  Driven<Law> cloth(law(couple(m0)));
  hold(cloth, kK1, 0);
  hold(cloth, kK1, kHold);
  const double first = (m0 + kK1 * kC * (1 - std::exp(-kHold / kTau))) / (kB + kC);
  ASSERT_GT(first, stop);
  expect_recovery(cloth,
                  [&](double t) { return stop + (first - stop) * std::exp(-t * kB / ((kB + kC) * kTau)); });
}

// Where friction holds more than that from the start, nothing moves afterwards.
TEST(Chapman, StaysWhereFrictionHoldsItsSpringBack) {
  const double m0 = 1.9e-3;
  Driven<Law> cloth(law(couple(m0)));
  hold(cloth, kK1, 0);
  hold(cloth, kK1, kHold);
  const double first = (m0 + kK1 * kC * (1 - std::exp(-kHold / kTau))) / (kB + kC);
  ASSERT_LT(first, m0 / kB);
  expect_recovery(cloth, [&](double) { return first; });
}

TEST(Chapman, IsFrictionAloneWhereTheFabricHasNoBranches) {
  VirginCurve fabric = kCotton;
  fabric.parts.stops = {{5, 20}, {1e-5, 4e-6}};
  const LawParams choice = choose_law("chapman", fabric, {});
  const bool found = visit_group<PartsLaws, double, 3, LawMemorySizes>(choice, []<class Of>(const Of&) {
    EXPECT_TRUE((std::is_same_v<Of, SpectrumStops<double, 3, kFewStops>>));
  });
  EXPECT_TRUE(found);
}

}  // namespace
}  // namespace hysteron::testing
