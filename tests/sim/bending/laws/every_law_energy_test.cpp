// Energy of every law, scalar and tensor: what is spent is stored or lost, and what is lost does not come
// back.
#include <gtest/gtest.h>

#include "tests/sim/bending/laws/every_law.h"
#include "tests/sim/bending/laws/law_fixtures.h"

namespace hysteron::testing {
namespace {

constexpr double kSeconds = 0.05;  // of a step, where time matters

class EveryLawEnergy : public ::testing::TestWithParam<LawCase> {};
INSTANTIATE_TEST_SUITE_P(Laws, EveryLawEnergy, ::testing::ValuesIn(law_cases()), case_name);

template <class Law>
void expect_passive(const Law& law, const VirginCurve& c, bool passive) {
  for (unsigned seed = 1; seed <= 5; ++seed) {
    Driven<Law> cloth(law);
    const double rounding = 1e-14 * c.b1 * 4 * c.k0 * c.k0;
    for (const auto& k : random_tensors(2000, 2 * c.k0, seed)) {
      cloth.to(Vec<double, Law::kDimension>(k.head<Law::kDimension>()));
      ASSERT_GE(cloth.last.stored, 0);
      if (passive) {
        ASSERT_GE(cloth.last.dissipated, -rounding);
      }
    }
  }
}

TEST_P(EveryLawEnergy, ButWongNeverGivesBackWhatItLost) {
  const VirginCurve c = cotton_broad();
  const bool passive = GetParam().passive;
  with_law<double, 1>(GetParam(), c, kSeconds, [&](const auto& law) { expect_passive(law, c, passive); });
  with_law<double, 3>(GetParam(), c, kSeconds, [&](const auto& law) { expect_passive(law, c, passive); });
}

template <class Law>
void expect_balance(const Law& law) {
  const VirginCurve c = cotton_broad();
  Path<double, Law::kDimension> corners;
  for (const auto& k : random_tensors(6, 2 * c.k0, 4)) corners.push_back(k.head<Law::kDimension>());
  const double scale = c.friction_moment() * c.k0;
  // Fine enough for laws that stick and slip: below, their error depends on where in a step they slip.
  const double coarse = balance_error(law, corners, 4000), fine = balance_error(law, corners, 32000);
  constexpr double kFirstOrder = 0.8, kQuadratureRounding = 1e-10;
  EXPECT_LE(coarse, 0.1 * scale);
  if (fine > kQuadratureRounding * scale) {
    EXPECT_GE(std::log(coarse / fine) / std::log(8), kFirstOrder);
  }
}

TEST_P(EveryLawEnergy, StoresOrLosesTheWorkDoneAlongFinePaths) {
  with_law<double, 1>(GetParam(), cotton_broad(), 0, [](const auto& law) { expect_balance(law); });
  with_law<double, 3>(GetParam(), cotton_broad(), 0, [](const auto& law) { expect_balance(law); });
}

// W(K) = stored + dissipated from a given state: its slope is the moment, and it is convex.
template <class Law>
void expect_potential(const Law& law, bool has_potential) {
  constexpr int D = Law::kDimension;
  const VirginCurve c = cotton_broad();
  Driven<Law> cloth(law);
  for (const auto& k : random_tensors(7, 1.5 * c.k0, 30)) cloth.to(Vec<double, D>(k.head<D>()));
  const double step = c.k0 / 37, rounding = 1e-12 * c.b1 * c.k0 * c.k0;  // 37: unrelated to any threshold
  for (const auto& k : random_tensors(100, 2 * c.k0, 31)) {
    const Vec<double, D> here = k.head<D>(), way = step * Vec<double, D>::Ones();
    const auto at = [&](double t) { return law.step(Vec<double, D>(here + t * way), cloth.history); };
    const auto w = [&](double t) { return at(t).stored + at(t).dissipated; };
    ASSERT_GE(at(1).moment.dot(way) - at(-1).moment.dot(way), -rounding);  // M increases along any way
    if (!has_potential) continue;
    const double h = 1e-4, stiff = law.largest_stiffness();
    ASSERT_NEAR((w(h) - w(-h)) / (2 * h), at(0).moment.dot(way),
                2 * stiff * way.squaredNorm() * h + rounding / h);
  }
}

// Creep and fatigue lose energy at the end of a step, beside the potential.
TEST_P(EveryLawEnergy, HasAConvexPotentialWithinAStep) {
  const bool late_losses = GetParam().name.ends_with("fatigue") || GetParam().timed;
  with_law<double, 1>(GetParam(), cotton_broad(), kSeconds,
                      [&](const auto& law) { expect_potential(law, !late_losses); });
  with_law<double, 3>(GetParam(), cotton_broad(), kSeconds,
                      [&](const auto& law) { expect_potential(law, !late_losses); });
}

// Measurements evaluate the law again where it is; they must find what the step left.
template <class Law>
void expect_repeatable(Law law) {
  const VirginCurve c = cotton_broad();
  Driven<Law> cloth(law);
  set_step_time(law, 0.0);
  const double rounding = 1e-12 * c.b1 * c.k0 * c.k0;
  for (const auto& k : random_tensors(200, 2 * c.k0, 5)) {
    const Vec<double, Law::kDimension> here = k.head<Law::kDimension>();
    cloth.to(here);
    ASSERT_NEAR(law.step(here, cloth.history).stored, cloth.last.stored, rounding);
    ASSERT_NEAR(law.step(here, cloth.history).dissipated, 0, rounding);
  }
}

TEST_P(EveryLawEnergy, IsFoundAsItWasLeft) {
  with_law<double, 1>(GetParam(), cotton_broad(), kSeconds, [](const auto& law) { expect_repeatable(law); });
  with_law<double, 3>(GetParam(), cotton_broad(), kSeconds, [](const auto& law) { expect_repeatable(law); });
}

}  // namespace
}  // namespace hysteron::testing
