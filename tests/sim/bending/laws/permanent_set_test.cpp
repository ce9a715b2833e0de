// A rest curvature sets beyond a yield curvature: these tests have closed forms of one bend, beside friction
// and branches.
#include <gtest/gtest.h>

#include "sim/bending/laws/law_run.h"
#include "sim/bending/laws/measured_law.h"
#include "tests/sim/bending/laws/law_fixtures.h"

namespace hysteron::testing {
namespace {

constexpr double kB2 = 1e-5, kYield = 150, kHardening = 4e-6;  // [N m], [1/m], [N m]
constexpr double kSetRounding = 1e-11;                         // relative

using SettingStops = SpectrumStops<double, 1, 8>;

PermanentSetLaw<SettingStops> setting_law(const Spectrum& friction = {}) {
  return PermanentSetLaw<SettingStops>::make(SettingStops::make(kB2, friction, {}), kB2,
                                             {kYield, kHardening});
}
double set_curvature(const Driven<PermanentSetLaw<SettingStops>>& cloth) {
  return PermanentSetLaw<SettingStops>::set_curvature(cloth.history)[0];
}

TEST(PermanentSet, IsNoneBelowTheYieldCurvature) {
  Driven<PermanentSetLaw<SettingStops>> cloth(setting_law());
  for (double k : {kYield, -kYield, 0.5 * kYield}) {
    EXPECT_NEAR(cloth.moment(k), kB2 * k, kSetRounding * kB2 * kYield);
    EXPECT_EQ(set_curvature(cloth), 0);
  }
  EXPECT_EQ(cloth.dissipated, 0);
}

// b2 (K - K_p) - h K_p = b2 K_y:  K_p = b2 (K - K_y)/(b2 + h), slope b2 h/(b2 + h) beyond.
TEST(PermanentSet, GrowsWithTheBendAsHardeningHasIt) {
  Driven<PermanentSetLaw<SettingStops>> cloth(setting_law());
  for (double k : {200.0, 400.0, 600.0}) {
    const double moment = cloth.moment(k), set = kB2 * (k - kYield) / (kB2 + kHardening);
    EXPECT_NEAR(set_curvature(cloth), set, kSetRounding * k);
    EXPECT_NEAR(moment, kB2 * (k - set), kSetRounding * kB2 * k);
    EXPECT_NEAR(cloth.law.tangent(Vec<double, 1>(k + 1), cloth.history)(0, 0),
                kB2 * kHardening / (kB2 + kHardening), kSetRounding * kB2);
  }
  const double set = set_curvature(cloth);
  EXPECT_NEAR(cloth.dissipated, kB2 * kYield * set, kSetRounding * kB2 * kYield * set);
  EXPECT_NEAR(cloth.law.residual(cloth.history)[0], set, kSetRounding * set);
}

// Let go, a set that has hardened beyond b2 K_y flows back until it has not: h K_p = b2 K_y.
TEST(PermanentSet, IsLeftUpToTheYieldMomentOverTheHardening) {
  for (double k : {700.0, 1200.0, 5000.0}) {
    Driven<PermanentSetLaw<SettingStops>> cloth(setting_law());
    cloth.moment(k);
    ASSERT_GT(kHardening * set_curvature(cloth), kB2 * kYield);
    const double most = kB2 * kYield / kHardening;
    EXPECT_NEAR(cloth.law.residual(cloth.history)[0], most, kSetRounding * most);
  }
}

// Beyond all thresholds friction is HB: b2 (K - K_p) + HB - h K_p = b2 K_y.  Released, friction leaves HB/b2
// more than the set: the two phenomena that the chapter tells apart.
TEST(PermanentSet, AndFrictionLeaveTheirResidualCurvaturesSideBySide) {
  const Spectrum friction{{5, 30}, {2e-5, 1e-5}};
  const double hb = friction.friction_moment(), k = 600;
  Driven<PermanentSetLaw<SettingStops>> cloth(setting_law(friction));
  cloth.moment(k);
  const double set = (kB2 * (k - kYield) + hb) / (kB2 + kHardening);
  EXPECT_NEAR(set_curvature(cloth), set, kSetRounding * k);
  EXPECT_NEAR(cloth.law.residual(cloth.history)[0], set + hb / kB2, kSetRounding * k);
}

// The remainder of a fold that was bent back beyond its yield does not depend on its elements' division.
TEST(PermanentSet, IsTheSameInOneStepAsInManyOfOneDirection) {
  const Spectrum friction{{5, 30}, {2e-5, 1e-5}};
  for (double turn : {700.0, -900.0}) {
    Driven<PermanentSetLaw<SettingStops>> one(setting_law(friction)), many(setting_law(friction));
    one.moment(turn);
    for (int i = 1; i <= 1000; ++i) many.moment(turn * i / 1000);
    EXPECT_NEAR(set_curvature(many), set_curvature(one), 1e-9 * std::abs(turn));
    EXPECT_NEAR(many.last.moment[0], one.last.moment[0], 1e-9 * kB2 * std::abs(turn));
  }
}

// Held for long, branches have let go: their share of the moment sets nothing any more, but it did when the
// fold was fast.
TEST(PermanentSet, IsLargerInAFastFoldThanInASlowOne) {
  using Relaxed = Relaxing<SettingStops, kMaxBranches>;
  const auto folded = [](double seconds) {
    const Relaxed inner = Relaxed::make(SettingStops::make(kB2, {}, {}), {{1}, {5e-6}});
    Driven cloth(PermanentSetLaw<Relaxed>::make(inner, kB2, {kYield, kHardening}));
    cloth.law.law.dt = seconds / 100;
    for (int i = 1; i <= 100; ++i) cloth.moment(300.0 * i / 100);
    return PermanentSetLaw<Relaxed>::set_curvature(cloth.history)[0];
  };
  const double fast = (1.5e-5 * 300 - kB2 * kYield) / (1.5e-5 + kHardening),
               slow = (kB2 * 300 - kB2 * kYield) / (kB2 + kHardening);
  constexpr double kAtOnce = 1e-3, kForever = 1e-2;
  EXPECT_NEAR(folded(1e-4), fast, kAtOnce * fast);
  EXPECT_NEAR(folded(1e5), slow, kForever * slow);
}

TEST(PermanentSet, OfAFabricIsWhatItsWalkReports) {
  VirginCurve fabric{kB2, kB2, 0, {{}, {}, {}, {kYield, kHardening}}};
  LawWalk walk({"prandtl", fabric, {}});
  walk.to({500});
  const double set = kB2 * (500 - kYield) / (kB2 + kHardening);
  EXPECT_NEAR(walk.permanent_set(), set, kSetRounding * set);
  EXPECT_NEAR(walk.residual(), set, kSetRounding * set);
}

}  // namespace
}  // namespace hysteron::testing
