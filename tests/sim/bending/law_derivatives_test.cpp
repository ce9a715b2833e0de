// Tangents against differences of the moment, by observed order; single against double precision.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include "sim/bending/four_directions.h"
#include "sim/bending/linear.h"
#include "sim/bending/pabst.h"
#include "sim/bending/prandtl_stack.h"
#include "sim/bending/prandtl_stops.h"
#include "sim/bending/wong.h"
#include "tests/sim/bending/law_fixtures.h"

namespace hysteron::testing {
namespace {

// Largest entry of tangent minus central difference at `curvature`, relative to the tangent's.
template <class Law>
double tangent_error(const Law& law, const History<double, Law::kHistory>& state,
                     const Vec<double, Law::kDimension>& curvature, double h) {
  constexpr int D = Law::kDimension;
  const Tangent<double, D> tangent = law.tangent(curvature, state);
  Tangent<double, D> difference;
  for (int a = 0; a < D; ++a) {
    const Vec<double, D> along = h * Vec<double, D>::Unit(a);
    difference.col(a) = (law.step(Vec<double, D>(curvature + along), state).moment -
                         law.step(Vec<double, D>(curvature - along), state).moment) /
                        (2 * h);
  }
  return (tangent - difference).cwiseAbs().maxCoeff() / tangent.cwiseAbs().maxCoeff();
}

template <class Law>
void expect_tangent(const Law& law) {
  constexpr int D = Law::kDimension;
  const VirginCurve c = cotton_broad();
  Driven<Law> cloth(law);
  for (const auto& k : random_tensors(5, 1.5 * c.k0, 41)) cloth.to(Vec<double, D>(k.head<D>()));
  const double coarse = 3e-2, fine = 3e-3;  // 1/m: nearer than any kink at all but a few points
  int measured = 0, second_order = 0;
  for (const auto& k : random_tensors(60, 2 * c.k0, 42)) {
    const Vec<double, D> here = k.head<D>();
    const Tangent<double, D> tangent = law.tangent(here, cloth.history);
    ASSERT_GT(tangent.cwiseAbs().maxCoeff(), 0);
    ASSERT_LE((tangent - tangent.transpose()).norm(), 1e-15 * tangent.norm());
    const Vec<double, D> eigen = tangent.template selfadjointView<Eigen::Lower>().eigenvalues();
    constexpr double kFrame = 5e-3;  // four directions reproduce a plate within half a per cent
    ASSERT_GE(eigen.minCoeff(), c.b2 * (1 - kFrame));
    ASSERT_LE(eigen.maxCoeff(), law.largest_stiffness() * (1 + 1e-12));
    const double e1 = tangent_error(law, cloth.history, here, coarse),
                 e2 = tangent_error(law, cloth.history, here, fine);
    constexpr double kDifferenceRounding = 2e-10;  // eps M/(h b2)
    ++measured;
    second_order += e2 < kDifferenceRounding || std::log10(e1 / e2) > 1.9;
  }
  EXPECT_GE(second_order, 0.9 * measured);  // the others have a kink within 3e-2/m
}

TEST(Tangent, IsTheDerivativeOfTheMomentToSecondOrder) {
  const VirginCurve c = cotton_broad();
  expect_tangent(Linear<double, 1>::make(c));
  expect_tangent(Pabst<double, 1>::make(c));
  expect_tangent(PrandtlStops<double, 1, 8>::make(c));
  expect_tangent(PrandtlStack<double, 8>::make(c));
  expect_tangent(Wong<double>::make(c));
  expect_tangent(Wong<double>::make(c, Recovery::kReversible));
  expect_tangent(Pabst<double, 3>::make(c));
  expect_tangent(PrandtlStops<double, 3, 8>::make(c));
  expect_tangent(FourDirections<Wong<double>>::make(c));
  expect_tangent(FourDirections<PrandtlStack<double, 8>>::make(c));
}

TEST(Tangent, IsTheInitialRigidityAtRest) {
  const VirginCurve c = cotton_broad();
  const Vec<double, 1> rest(0.0);
  EXPECT_DOUBLE_EQ((Pabst<double, 1>::make(c).tangent(rest, {})(0, 0)), c.b1);
  EXPECT_DOUBLE_EQ((PrandtlStops<double, 1, 8>::make(c).tangent(rest, {})(0, 0)), c.b1);
  EXPECT_DOUBLE_EQ((PrandtlStack<double, 8>::make(c).tangent(rest, {})(0, 0)), c.b1);
  EXPECT_DOUBLE_EQ(Wong<double>::make(c).tangent(rest, {})(0, 0), c.b1);
}

template <class Double, class Single>
void expect_single_close(const Double& exact, const Single& rough, unsigned seed) {
  constexpr int D = Double::kDimension;
  const VirginCurve c = cotton_broad();
  Driven<Double> fine(exact);
  Driven<Single> coarse(rough);
  constexpr double kSingle = 1e-5;  // about a hundred roundings of 6e-8
  for (const auto& k : random_tensors(200, 2 * c.k0, seed)) {
    const Vec<double, D> here = k.head<D>();
    const Vec<double, D> m = fine.to(here).moment;
    ASSERT_LE((m - coarse.to(here.template cast<float>().eval()).moment.template cast<double>()).norm(),
              kSingle * c.b1 * c.k0);
  }
  EXPECT_NEAR(coarse.dissipated, fine.dissipated, kSingle * 200 * c.friction_moment() * c.k0);
}

TEST(SinglePrecision, StaysCloseToDoubleOverTwoHundredReversals) {
  const VirginCurve c = cotton_broad();
  expect_single_close(Pabst<double, 3>::make(c), Pabst<float, 3>::make(c), 51);
  expect_single_close(PrandtlStops<double, 3, 8>::make(c), PrandtlStops<float, 3, 8>::make(c), 52);
  expect_single_close(PrandtlStack<double, 16>::make(c), PrandtlStack<float, 16>::make(c), 53);
  expect_single_close(Wong<double>::make(c), Wong<float>::make(c), 54);
  expect_single_close(FourDirections<Wong<double>>::make(c), FourDirections<Wong<float>>::make(c), 55);
}

}  // namespace
}  // namespace hysteron::testing
