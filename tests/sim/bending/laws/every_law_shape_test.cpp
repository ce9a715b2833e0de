// Every law as a function: tangents by observed order, tensors against scalars, residual curvature, single
// precision, extreme fabrics.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include "sim/bending/law_loop_of.h"
#include "tests/sim/bending/laws/every_law.h"
#include "tests/sim/bending/laws/law_fixtures.h"

namespace hysteron::testing {
namespace {

constexpr double kSeconds = 0.05;  // of a step, where time matters

class EveryLawShape : public ::testing::TestWithParam<LawCase> {};
INSTANTIATE_TEST_SUITE_P(Laws, EveryLawShape, ::testing::ValuesIn(law_cases()), case_name);

template <class Law>
double tangent_error(const Law& law, const History<double, Law::kHistory>& state,
                     const Vec<double, Law::kDimension>& curvature, double h) {
  constexpr int D = Law::kDimension;
  Tangent<double, D> difference;
  for (int a = 0; a < D; ++a) {
    const Vec<double, D> along = h * Vec<double, D>::Unit(a);
    difference.col(a) = (law.step(Vec<double, D>(curvature + along), state).moment -
                         law.step(Vec<double, D>(curvature - along), state).moment) /
                        (2 * h);
  }
  return (law.tangent(curvature, state) - difference).cwiseAbs().maxCoeff();
}

template <class Law>
void expect_tangent(const Law& law, double largest_curvature) {
  constexpr int D = Law::kDimension;
  const VirginCurve c = cotton_broad();
  Driven<Law> cloth(law);
  for (const auto& k : random_tensors(5, largest_curvature, 41)) cloth.to(Vec<double, D>(k.head<D>()));
  constexpr double kCoarse = 3e-2, kFine = 3e-3;  // [1/m] nearer than any kink at all but a few points
  int measured = 0, second_order = 0;
  for (const auto& k : random_tensors(60, largest_curvature, 42)) {
    const Vec<double, D> here = k.head<D>();
    const Tangent<double, D> tangent = law.tangent(here, cloth.history);
    ASSERT_LE((tangent - tangent.transpose()).norm(), 1e-14 * tangent.norm());
    ASSERT_LE(tangent.template selfadjointView<Eigen::Lower>().eigenvalues().maxCoeff(),
              law.largest_stiffness() * (1 + 1e-9));
    const double e1 = tangent_error(law, cloth.history, here, kCoarse),
                 e2 = tangent_error(law, cloth.history, here, kFine);
    const double rounding = 1e-15 * law.step(here, cloth.history).moment.norm() / kFine + 1e-9 * c.b2;
    ++measured;
    second_order += e2 < 10 * rounding || std::log10(e1 / e2) > 1.9;
  }
  EXPECT_GE(second_order, 0.9 * measured);  // the others have a kink within 3e-2/m
}

TEST_P(EveryLawShape, TangentIsTheDerivativeOfTheMomentToSecondOrder) {
  const double largest = 2 * cotton_broad().k0;
  with_law<double, 1>(GetParam(), cotton_broad(), kSeconds,
                      [&](const auto& law) { expect_tangent(law, largest); });
  with_law<double, 3>(GetParam(), cotton_broad(), kSeconds,
                      [&](const auto& law) { expect_tangent(law, largest); });
}

Vec<double, 3> cylinder(double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return {c * c, s * s, std::sqrt(2) * c * s};
}

template <class Tensor, class Scalar>
void expect_cylinders_follow(const Tensor& tensor, const Scalar& scalar) {
  const VirginCurve c = cotton_broad();
  constexpr double kRounding = 1e-12;
  for (int direction = 0; direction < 24; ++direction) {
    const Vec<double, 3> bend = cylinder(3.14159265358979323846 * direction / 24);
    Driven<Tensor> sheet(tensor);
    Driven<Scalar> strip(scalar);
    for (double k : random_turns(60, 2 * c.k0, 61)) {
      const double m = strip.moment(k);
      ASSERT_LE((sheet.to(Vec<double, 3>(k * bend)).moment - m * bend).norm(), kRounding * c.b1 * c.k0);
      ASSERT_NEAR(sheet.last.stored, strip.last.stored, kRounding * c.b1 * c.k0 * c.k0);
      ASSERT_NEAR(sheet.last.dissipated, strip.last.dissipated, kRounding * c.b1 * c.k0 * c.k0);
    }
  }
}

template <class T>
inline constexpr bool kRunsAlongFourDirections = false;
template <class Law>
inline constexpr bool kRunsAlongFourDirections<FourDirections<Law>> = true;

TEST_P(EveryLawShape, RadialTensorLawsFollowTheScalarLawOnACylinderInAnyDirection) {
  const VirginCurve c = cotton_broad();
  with_law<double, 3>(GetParam(), c, kSeconds, [&]<class Tensor>(const Tensor& tensor) {
    if (!GetParam().radial()) GTEST_SKIP() << "slips on ellipsoids (spectrum_test.cpp)";
    if constexpr (kRunsAlongFourDirections<Tensor>) {
      GTEST_SKIP() << "runs along four directions (tensor_law_test.cpp says how well)";
    } else {
      with_law<double, 1>(GetParam(), c, kSeconds,
                          [&](const auto& scalar) { expect_cylinders_follow(tensor, scalar); });
    }
  });
}

template <class Law>
void expect_momentless_residual(const Law& law) {
  constexpr double kNewton = 1e-9;
  const VirginCurve c = cotton_broad();
  Driven<Law> cloth(law);
  for (const auto& k : random_tensors(30, 2 * c.k0, 7)) {
    cloth.to(Vec<double, Law::kDimension>(k.head<Law::kDimension>()));
    Law at_rest = law;
    set_step_time(at_rest, typename Law::Scalar(0));
    const auto moment = at_rest.step(at_rest.residual(cloth.history), cloth.history).moment;
    ASSERT_LE(moment.norm(), kNewton * c.b1 * c.k0);
  }
}

TEST_P(EveryLawShape, CarriesNoMomentAtItsResidualCurvature) {
  with_law<double, 1>(GetParam(), cotton_broad(), kSeconds,
                      [](const auto& law) { expect_momentless_residual(law); });
  with_law<double, 3>(GetParam(), cotton_broad(), kSeconds,
                      [](const auto& law) { expect_momentless_residual(law); });
}

template <class Double, class Single>
void expect_single_close(const Double& exact, const Single& rough) {
  constexpr int D = Double::kDimension;
  const VirginCurve c = cotton_broad();
  Driven<Double> fine(exact);
  Driven<Single> coarse(rough);
  constexpr double kSingle = 2e-5;  // some hundred roundings of 6e-8
  for (const auto& k : random_tensors(200, 2 * c.k0, 51)) {
    const Vec<float, D> here = k.head<D>().template cast<float>();
    const Vec<double, D> m = fine.to(Vec<double, D>(here.template cast<double>())).moment;
    ASSERT_LE((m - coarse.to(here).moment.template cast<double>()).norm(), kSingle * c.b1 * c.k0);
  }
  EXPECT_NEAR(coarse.dissipated, fine.dissipated, kSingle * 200 * c.friction_moment() * c.k0);
}

TEST_P(EveryLawShape, InSinglePrecisionStaysCloseToDouble) {
  const VirginCurve c = cotton_broad();
  with_law<double, 3>(GetParam(), c, kSeconds, [&](const auto& exact) {
    with_law<float, 3>(GetParam(), c, kSeconds,
                       [&](const auto& rough) { expect_single_close(exact, rough); });
  });
}

template <class Law>
void expect_finite(const Law& law, const VirginCurve& c, bool passive) {
  Driven<Law> cloth(law);
  const double largest = 3 * std::max(c.k0, c.friction_moment() / c.b2);
  const double scale = (law.largest_stiffness() * largest + c.friction_moment()) * largest;
  for (const auto& k : random_tensors(200, std::min(largest, 3000.0), 8)) {
    cloth.to(Vec<double, Law::kDimension>(k.head<Law::kDimension>()));
    ASSERT_TRUE(cloth.last.moment.allFinite());
    ASSERT_TRUE(std::isfinite(cloth.last.stored) && std::isfinite(cloth.last.dissipated));
    if (passive) {
      ASSERT_GE(cloth.last.dissipated, -1e-13 * scale);
    }
  }
}

TEST_P(EveryLawShape, BehavesOnExtremeFabrics) {
  for (const double b1 : {1e-8, 1e-5, 1e-3})
    for (const double k0 : {1.0, 50.0, 1000.0})
      for (const double ratio : {1.0, 0.3, 1e-6}) {  // b2/b1: elastic, common, M0 >> b2 K0
        const VirginCurve c{b1, ratio * b1, k0};
        SCOPED_TRACE(::testing::Message() << "b1 = " << b1 << ", b2 = " << c.b2 << ", k0 = " << k0);
        LawCase extreme = GetParam();
        if (extreme.parameters.count("fatigue.m-inf")) extreme.parameters["fatigue.m-inf"] = "0";
        if (extreme.law == "spring") extreme.parameters["height"] = std::to_string(1 / k0);
        with_law<double, 1>(extreme, c, kSeconds,
                            [&](const auto& law) { expect_finite(law, c, extreme.passive); });
        with_law<double, 3>(extreme, c, kSeconds,
                            [&](const auto& law) { expect_finite(law, c, extreme.passive); });
      }
}

template <class Law>
void expect_round_trip(const Law& law) {
  if constexpr (Law::kHistory > 0) {
    constexpr int kElements = 5;
    std::vector<double> memory(kElements * Law::kHistory);
    std::vector<Driven<Law>> cloths(kElements, Driven<Law>(law));
    for (int i = 0; i < kElements; ++i) {
      for (const auto& k : random_tensors(9, 100, 70 + i))
        cloths[i].to(Vec<double, Law::kDimension>(k.head<Law::kDimension>()));
      store_history<Law>(memory.data(), i, kElements, cloths[i].history);
    }
    for (int i = 0; i < kElements; ++i) {
      const auto back = load_history<Law>(memory.data(), i, kElements);
      for (int k = 0; k < Law::kHistory; ++k) ASSERT_EQ(back[k], cloths[i].history[k]);
    }
  }
}

TEST_P(EveryLawShape, HistoryComesBackFromMemoryAsItWas) {
  with_law<double, 1>(GetParam(), cotton_broad(), kSeconds, [](const auto& law) { expect_round_trip(law); });
  with_law<double, 3>(GetParam(), cotton_broad(), kSeconds, [](const auto& law) { expect_round_trip(law); });
}

}  // namespace
}  // namespace hysteron::testing
