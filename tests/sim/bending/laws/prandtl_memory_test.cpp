// The two memories of `prandtl` are compared with very many stops, by return points, and where the stack is
// full.
#include <gtest/gtest.h>

#include "sim/bending/laws/prandtl_stack.h"
#include "sim/bending/laws/prandtl_stops.h"
#include "tests/sim/bending/laws/law_fixtures.h"

namespace hysteron::testing {
namespace {

// The law by its definition, with any number of stops, written plainly and apart from the law under test.
class ManyStops {
 public:
  enum class Spacing { even, quadratic };
  // Thresholds in the middle of stretches of [0, k0] that are alike, or that end at k0 (j/N)^2.
  ManyStops(const VirginCurve& curve, int count, Spacing spacing = Spacing::even)
      : curve_(curve), slip_(size_t(count)) {
    const auto end = [&](int j) {
      const double share = double(j) / count;
      return curve.k0 * (spacing == Spacing::even ? share : share * share);
    };
    for (int j = 0; j < count; ++j) {
      threshold_.push_back((end(j) + end(j + 1)) / 2);
      stiffness_.push_back((curve.b1 - curve.b2) * (end(j + 1) - end(j)) / curve.k0);
    }
  }

  struct Outcome {
    double moment, stored, dissipated;
  };
  Outcome to(double k) {
    Outcome result{curve_.b2 * k, curve_.b2 * k * k / 2, 0};
    for (size_t j = 0; j < slip_.size(); ++j) {
      const double r = threshold_[j], p = stiffness_[j], u = k - slip_[j];
      const double e = std::abs(u) < r ? u : std::copysign(r, u);
      result.moment += p * e;
      result.stored += p * e * e / 2;
      result.dissipated += p * std::abs(e) * (std::abs(u) - std::abs(e));
      slip_[j] = k - e;
    }
    return result;
  }

 private:
  VirginCurve curve_;
  std::vector<double> slip_, threshold_, stiffness_;
};

constexpr int kLongStack = 10000;
// A stop's threshold stands for an interval K0/N: 1/(4 N^2) on the virgin curve, twice that per branch.
constexpr double kDiscretisation = 40 / (4. * kLongStack * kLongStack);  // up to 20 branches on the stack

TEST(PrandtlStack, EqualsTenThousandStopsOnRandomHistories) {
  const double m0 = kCotton.friction_moment();
  Driven cloth(PrandtlStack<double, 64>::make(kCotton));
  ManyStops reference(kCotton, kLongStack);
  for (double k : random_turns(400, 2 * kCotton.k0, 5)) {
    const auto expected = reference.to(k);
    ASSERT_NEAR(cloth.moment(k), expected.moment, kDiscretisation * m0);
    ASSERT_NEAR(cloth.last.stored, expected.stored, kDiscretisation * m0 * kCotton.k0);
    ASSERT_NEAR(cloth.last.dissipated, expected.dissipated, kDiscretisation * m0 * kCotton.k0);
  }
  EXPECT_EQ(cloth.law.dropped_pairs(cloth.history), 0);
}

TEST(PrandtlStack, EqualsAThousandStopsOnAThousandRandomHistories) {
  constexpr int kStops = 1000;
  const double near = 40 / (4. * kStops * kStops) * kCotton.friction_moment();  // as above
  for (unsigned seed = 1; seed <= 1000; ++seed) {
    Driven cloth(PrandtlStack<double, 64>::make(kCotton));
    ManyStops reference(kCotton, kStops);
    for (double k : random_turns(40, 2 * kCotton.k0, seed))
      ASSERT_NEAR(cloth.moment(k), reference.to(k).moment, near);
  }
}

TEST(PrandtlStops, EqualsItsDefinitionOnRandomHistories) {
  constexpr double kRounding = 1e-13;
  Driven cloth(PrandtlStops<double, 1, 16>::make(kCotton));
  ManyStops reference(kCotton, 16, ManyStops::Spacing::quadratic);
  for (double k : random_turns(400, 2 * kCotton.k0, 6)) {
    const auto expected = reference.to(k);
    ASSERT_NEAR(cloth.moment(k), expected.moment, kRounding * kCotton.b1 * kCotton.k0);
    ASSERT_NEAR(cloth.last.stored, expected.stored, kRounding * kCotton.b1 * kCotton.k0 * kCotton.k0);
    ASSERT_NEAR(cloth.last.dissipated, expected.dissipated, kRounding * kCotton.b1 * kCotton.k0 * kCotton.k0);
  }
}

TEST(PrandtlStops, ComeWithinTwiceTheirVirginErrorPerBranchOfTenThousand) {
  Driven cloth(PrandtlStops<double, 1, 8>::make(kCotton));
  ManyStops reference(kCotton, kLongStack);
  constexpr double kTurnsOfThisHistory = 5;
  const double bound = 2 * kTurnsOfThisHistory * kCotton.friction_moment() / (8 * 8);
  for (double k : {1.7, -0.4, 0.9, 0.1, 0.7, 1.9})
    EXPECT_NEAR(cloth.moment(k * kCotton.k0), reference.to(k * kCotton.k0).moment, bound);
}

template <class Law>
void expect_return_points(const Law& law, double tolerance) {
  const double k0 = kCotton.k0;
  Driven<Law> looped(law), direct(law);
  const double outer = looped.moment(1.5 * k0);
  looped.moment(-0.3 * k0);
  const double inner = looped.moment(0.8 * k0);
  looped.moment(0.2 * k0);
  EXPECT_NEAR(looped.moment(0.8 * k0), inner, tolerance);  // the inner loop closes
  for (double k : {1.5, -0.3}) direct.moment(k * k0);
  for (double k : {0.9, 1.2, 1.4}) EXPECT_NEAR(looped.moment(k * k0), direct.moment(k * k0), tolerance);
  EXPECT_NEAR(looped.moment(1.5 * k0), outer, tolerance);  // and so does the outer one
}

TEST(Prandtl, RemembersItsReturnPoints) {
  constexpr double kRounding = 1e-13;
  expect_return_points(PrandtlStack<double, 8>::make(kCotton), kRounding * kCotton.b1 * kCotton.k0);
  expect_return_points(PrandtlStops<double, 1, 8>::make(kCotton), kRounding * kCotton.b1 * kCotton.k0);
}

TEST(Prandtl, PassingTheMirrorImageOfTheFirstReversalReturnsToTheVirginCurve) {
  Driven bent(PrandtlStack<double, 8>::make(kCotton)), fresh(bent.law);
  bent.moment(0.5 * kCotton.k0);
  const double k = -0.7 * kCotton.k0;
  EXPECT_DOUBLE_EQ(bent.moment(k), fresh.moment(k));
  EXPECT_DOUBLE_EQ(bent.last.stored, fresh.last.stored);
}

TEST(Prandtl, AStepInOnePieceEqualsManySmallOnes) {
  constexpr double kRounding = 1e-12;  // a thousand sums
  Driven coarse(PrandtlStack<double, 16>::make(kCotton)), fine(coarse.law);
  double at = 0;
  for (double target : random_turns(50, 1.5 * kCotton.k0, 8)) {
    coarse.moment(target);
    for (int i = 1; i <= 20; ++i) fine.moment(at + (target - at) * i / 20);
    at = target;
    ASSERT_NEAR(coarse.last.moment[0], fine.last.moment[0], kRounding * kCotton.b1 * kCotton.k0);
    ASSERT_NEAR(coarse.dissipated, fine.dissipated, kRounding * kCotton.b1 * kCotton.k0 * kCotton.k0 * 50);
  }
}

template <int Depth>
void expect_no_jumps(unsigned seed) {
  Driven cloth(PrandtlStack<double, Depth>::make(kCotton));
  constexpr double kRounding = 1e-12;
  double at = 0, moment = 0;
  for (double target : random_turns(3000, 2 * kCotton.k0, seed)) {
    for (int i = 1; i <= 10; ++i) {
      const double increment = (target - at) / 10, k = i < 10 ? at + increment * i : target, before = moment;
      moment = cloth.moment(k);
      // Increasing, never steeper than b1: no jump, at any step size.
      ASSERT_LE(std::abs(moment - before),
                kCotton.b1 * std::abs(increment) + kRounding * kCotton.friction_moment());
      ASSERT_GE(
          (moment - before) * increment,
          (kCotton.b2 * increment * increment) - kRounding * kCotton.friction_moment() * std::abs(increment));
      ASSERT_LE(std::abs(moment - kCotton.b2 * k), kCotton.friction_moment() * (1 + kRounding));
    }
    at = target;
  }
  EXPECT_GT(cloth.law.dropped_pairs(cloth.history), 0);  // otherwise nothing was tested
}

TEST(PrandtlStack, BoundedStackNeverLetsTheMomentJump) {
  expect_no_jumps<4>(1);
  expect_no_jumps<5>(2);
  expect_no_jumps<8>(3);
}

TEST(PrandtlStack, CountsThePairsItDrops) {
  const double k0 = kCotton.k0;
  Driven cloth(PrandtlStack<double, 4>::make(kCotton));
  for (double k : {0.9, -0.8, 0.7, -0.6, 0.5}) cloth.moment(k * k0);
  EXPECT_EQ(cloth.law.dropped_pairs(cloth.history), 0);  // four turns fit
  cloth.moment(-0.4 * k0);
  EXPECT_EQ(cloth.law.dropped_pairs(cloth.history), 1);
}

TEST(PrandtlStack, LoopAreaMatchesClosedForm) {
  const double m0 = kCotton.friction_moment();
  const auto law = PrandtlStack<double, 8>::make(kCotton);
  constexpr double kRounding = 1e-13;
  for (double a : {0.1, 0.5, 0.9, 1.0}) {
    const double amplitude = a * kCotton.k0,
                 area = 4. / 3 * -kCotton.c1() * amplitude * amplitude * amplitude;
    EXPECT_NEAR(Driven(law).cycle_loss(amplitude), area, kRounding * m0 * kCotton.k0);
  }
  for (double a : {1.0, 1.5, 4.0})
    EXPECT_NEAR(Driven(law).cycle_loss(a * kCotton.k0), 4 * m0 * (a * kCotton.k0 - 2 * kCotton.k0 / 3),
                kRounding * m0 * kCotton.k0 * a);
}

TEST(PrandtlStops, EachStopEnclosesFourLimitsTimesTheSlippedWay) {
  constexpr int kStops = 8;
  const double amplitude = 0.7 * kCotton.k0;
  double area = 0;
  for (int j = 1; j <= kStops; ++j) {
    const double stiffness = (kCotton.b1 - kCotton.b2) * (2 * j - 1) / (kStops * kStops);
    const double threshold = kCotton.k0 * (j * j - j + 0.5) / (kStops * kStops);
    area += std::max(0.0, 4 * stiffness * threshold * (amplitude - threshold));
  }
  constexpr double kRounding = 1e-13;
  const auto law = PrandtlStops<double, 1, kStops>::make(kCotton);
  EXPECT_NEAR(Driven(law).cycle_loss(amplitude), area, kRounding * kCotton.friction_moment() * kCotton.k0);
}

}  // namespace
}  // namespace hysteron::testing
