// Energy: what is spent is stored or lost, and what is lost does not come back.
#include <gtest/gtest.h>

#include "sim/bending/four_directions.h"
#include "sim/bending/linear.h"
#include "sim/bending/pabst.h"
#include "sim/bending/prandtl_stack.h"
#include "sim/bending/prandtl_stops.h"
#include "sim/bending/wong.h"
#include "tests/sim/bending/law_fixtures.h"

namespace hysteron::testing {
namespace {

template <class Law, class Walk>
void expect_passive(const Law& law, const Walk& walk) {
  Driven<Law> cloth(law);
  for (const auto& k : walk) {
    cloth.to(Vec<double, Law::kDimension>(k));
    ASSERT_GE(cloth.last.dissipated, 0);
    ASSERT_GE(cloth.last.stored, 0);
  }
}

TEST(Passivity, NoLawButWongGivesEnergyBackOnRandomHistories) {
  const VirginCurve c = cotton_broad();
  for (unsigned seed = 1; seed <= 5; ++seed) {
    const auto turns = random_turns(2000, 2 * c.k0, seed);
    expect_passive(Linear<double, 1>::make(c), turns);
    expect_passive(Pabst<double, 1>::make(c), turns);
    expect_passive(PrandtlStops<double, 1, 8>::make(c), turns);
    expect_passive(PrandtlStack<double, 64>::make(c), turns);
  }
}

TEST(Passivity, HoldsOnRandomHistoriesOfTensors) {
  const VirginCurve c = cotton_broad();
  for (unsigned seed = 1; seed <= 5; ++seed) {
    const auto tensors = random_tensors(2000, 2 * c.k0, seed);
    expect_passive(Linear<double, 3>::make(c), tensors);
    expect_passive(Pabst<double, 3>::make(c), tensors);
    expect_passive(PrandtlStops<double, 3, 8>::make(c), tensors);
    expect_passive(FourDirections<PrandtlStack<double, 64>>::make(c), tensors);
  }
}

// Work int M dK along straight pieces by the trapezium rule; the moment is piecewise smooth.
template <class Law>
double balance_error(const Law& law, const Path<double, Law::kDimension>& corners, int pieces) {
  Driven<Law> cloth(law);
  Vec<double, Law::kDimension> at = Vec<double, Law::kDimension>::Zero(), moment = at;
  double work = 0;
  for (const auto& corner : corners) {
    const Vec<double, Law::kDimension> way = (corner - at) / pieces;
    for (int i = 1; i <= pieces; ++i) {
      cloth.to(Vec<double, Law::kDimension>(at + way * i));
      work += (moment + cloth.last.moment).dot(way) / 2;
      moment = cloth.last.moment;
    }
    at = corner;
  }
  return std::abs(work - cloth.last.stored - cloth.dissipated);
}

template <class Law>
void expect_balance(const Law& law, const Path<double, Law::kDimension>& corners, double order) {
  const VirginCurve c = cotton_broad();
  constexpr int kCoarse = 400, kFine = 1600;
  const double scale = c.friction_moment() * c.k0;
  const double coarse = balance_error(law, corners, kCoarse), fine = balance_error(law, corners, kFine);
  EXPECT_LE(coarse, 0.1 * scale);
  constexpr double kOrderSlack = 0.25, kQuadratureRounding = 1e-11;
  if (fine > kQuadratureRounding * scale) {
    EXPECT_GE(std::log2(coarse / fine) / 2, order - kOrderSlack);
  }
}

Path<double, 1> scalar_corners() {
  Path<double, 1> corners;
  for (double k : {1.7, -0.3, 0.8, 0.1, 2.5, -3.0, 0.0})
    corners.push_back(Vec<double, 1>(k * cotton_broad().k0));
  return corners;
}

TEST(EnergyBalance, WorkIsStoredPlusDissipatedAlongFinePaths) {
  const VirginCurve c = cotton_broad();
  expect_balance(Linear<double, 1>::make(c), scalar_corners(), 2);
  expect_balance(Pabst<double, 1>::make(c), scalar_corners(), 2);
  expect_balance(PrandtlStack<double, 8>::make(c), scalar_corners(), 2);
  expect_balance(PrandtlStops<double, 1, 8>::make(c), scalar_corners(), 2);
  expect_balance(Wong<double>::make(c), scalar_corners(), 2);
  expect_balance(Wong<double>::make(c, Recovery::kReversible), scalar_corners(), 2);
}

TEST(EnergyBalance, HoldsForTensorsAsTheStepShrinks) {
  const VirginCurve c = cotton_broad();
  const auto corners = random_tensors(6, 2 * c.k0, 4);
  expect_balance(Pabst<double, 3>::make(c), corners, 2);
  expect_balance(FourDirections<PrandtlStack<double, 16>>::make(c), corners, 2);
  expect_balance(FourDirections<Wong<double>>::make(c), corners, 2);
  expect_balance(PrandtlStops<double, 3, 8>::make(c), corners, 1);  // radial return is a first-order scheme
}

TEST(EnergyBalance, HoldsForABoundedStackThatDropsPairs) {
  const VirginCurve c = cotton_broad();
  const auto law = PrandtlStack<double, 4>::make(c);
  Path<double, 1> corners;
  for (double k : random_turns(60, 2 * c.k0, 12)) corners.push_back(Vec<double, 1>(k));
  expect_balance(law, corners, 2);
}

// W(K) = stored + dissipated from a given state is convex and its derivative is the moment.
template <class Law>
void expect_convex_potential(const Law& law, const History<double, Law::kHistory>& state) {
  const VirginCurve c = cotton_broad();
  constexpr double kRounding = 1e-12;
  const double step = c.k0 / 37;  // unrelated to any threshold
  for (const auto& k : random_tensors(200, 2 * c.k0, 31)) {
    const Vec<double, Law::kDimension> here = k.head<Law::kDimension>();
    const Vec<double, Law::kDimension> way = Vec<double, Law::kDimension>::Ones() * step;
    const auto w = [&](double t) {
      const auto s = law.step(Vec<double, Law::kDimension>(here + t * way), state);
      return s.stored + s.dissipated;
    };
    ASSERT_GE(w(1) + w(-1) - 2 * w(0),
              c.b2 * way.squaredNorm() * (1 - 1e-6) - kRounding * c.b1 * c.k0 * c.k0);
    const double slope = law.step(here, state).moment.dot(way), h = 1e-5;
    ASSERT_NEAR((w(h) - w(-h)) / (2 * h), slope,
                2 * c.b1 * way.squaredNorm() * h + 1e-7 * c.b1 * c.k0 * step);
  }
}

template <class Law>
void expect_convex_from_bent_state(const Law& law) {
  Driven<Law> cloth(law);
  for (const auto& k : random_tensors(7, 1.5 * cotton_broad().k0, 30))
    cloth.to(Vec<double, Law::kDimension>(k.head<Law::kDimension>()));
  expect_convex_potential(law, cloth.history);
}

TEST(IncrementalPotential, IsConvexWithTheMomentAsItsSlope) {
  const VirginCurve c = cotton_broad();
  expect_convex_from_bent_state(PrandtlStops<double, 1, 8>::make(c));
  expect_convex_from_bent_state(PrandtlStack<double, 16>::make(c));
  expect_convex_from_bent_state(Wong<double>::make(c));
  expect_convex_from_bent_state(Wong<double>::make(c, Recovery::kReversible));
  expect_convex_from_bent_state(PrandtlStops<double, 3, 8>::make(c));
}

}  // namespace
}  // namespace hysteron::testing
