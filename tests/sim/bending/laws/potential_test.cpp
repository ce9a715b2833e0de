// The incremental potential of a step: its derivative is the moment, whatever is lost on the way, and it is
// convex where the model says so.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include "sim/bending/laws/law_potential.h"
#include "tests/sim/bending/laws/every_law.h"
#include "tests/sim/bending/laws/law_fixtures.h"

namespace hysteron::testing {
namespace {

constexpr double kSeconds = 0.05;  // of a step, where time matters

class StepPotential : public ::testing::TestWithParam<LawCase> {};
INSTANTIATE_TEST_SUITE_P(Laws, StepPotential, ::testing::ValuesIn(law_cases()), case_name);

template <class Law>
Driven<Law> with_past(const Law& law, double largest) {
  Driven<Law> cloth(law);
  for (const auto& k : random_tensors(7, largest, 51))
    cloth.to(Vec<double, Law::kDimension>(k.template head<Law::kDimension>()));
  return cloth;
}

// |W(k + h d) - W(k - h d) - 2 h M.d|
template <class Law>
double quotient_error(const Driven<Law>& cloth, const Vec<double, Law::kDimension>& k,
                      const Vec<double, Law::kDimension>& d, double h) {
  using V = Vec<double, Law::kDimension>;
  const double rise = step_potential(cloth.law, V(k + h * d), cloth.history) -
                      step_potential(cloth.law, V(k - h * d), cloth.history);
  return std::abs(rise - 2 * h * cloth.law.step(k, cloth.history).moment.dot(d));
}

template <class Law>
void expect_moment_is_its_derivative(const Law& law) {
  using V = Vec<double, Law::kDimension>;
  const double largest = 3 * cotton_broad().k0;
  const Driven<Law> cloth = with_past(law, largest);
  constexpr double kCoarse = 1e-1, kFine = 1e-2;  // [1/m]
  int third_order = 0, measured = 0;
  for (const auto& tensor : random_tensors(60, largest, 52)) {
    const V k = tensor.template head<Law::kDimension>(), d = V::Ones().normalized();
    ASSERT_GT(law.step(k, cloth.history).moment.norm(), 0);
    const double e1 = quotient_error(cloth, k, d, kCoarse), e2 = quotient_error(cloth, k, d, kFine);
    const double rounding = 1e-15 * std::abs(step_potential(law, k, cloth.history)) + 1e-18;
    ++measured;
    third_order += e2 < 20 * rounding || std::log10(e1 / e2) > 2.8;
  }
  EXPECT_GE(third_order, 0.85 * measured);  // the others have a kink of the tangent within 0.1/m
}

TEST_P(StepPotential, HasTheMomentAsItsDerivative) {
  const auto check = [](const auto& law) { expect_moment_is_its_derivative(law); };
  with_law<double, 1>(GetParam(), cotton_broad(), kSeconds, check);
  with_law<double, 3>(GetParam(), cotton_broad(), kSeconds, check);
}

// Least (M(a) - M(b)).(a - b)/|a - b|^2 over random pairs [N m].
template <class Law>
double least_secant(const Law& law, double largest) {
  using V = Vec<double, Law::kDimension>;
  const Driven<Law> cloth = with_past(law, largest);
  const auto points = random_tensors(200, largest, 53);
  double least = 1e30;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const V a = points[i].template head<Law::kDimension>(),
            b = points[i + 1].template head<Law::kDimension>();
    const V rise = law.step(a, cloth.history).moment - law.step(b, cloth.history).moment;
    least = std::min(least, rise.dot(a - b) / (a - b).squaredNorm());
  }
  return least;
}

TEST_P(StepPotential, IsConvexSoThatTheMomentIsMonotone) {
  // sin-shaped moments fall beyond their crest: 180 degrees of a hinge of 5 mm are 628/m.
  const bool falls_beyond_the_crest = GetParam().law == "bridson" || GetParam().law == "spring";
  const double largest = 3 * cotton_broad().k0;
  const auto check = [&](const auto& law) {
    EXPECT_GE(least_secant(law, largest), -1e-12);
    if (falls_beyond_the_crest) {
      EXPECT_LT(least_secant(law, 20 * largest), 0);
    } else {
      EXPECT_GE(least_secant(law, 20 * largest), -1e-12);
    }
  };
  with_law<double, 1>(GetParam(), cotton_broad(), kSeconds, check);
  with_law<double, 3>(GetParam(), cotton_broad(), kSeconds, check);
}

template <class Law>
void expect_nonnegative(const Law& law) {
  using V = Vec<double, Law::kDimension>;
  const Driven<Law> cloth = with_past(law, 3000);
  for (const auto& tensor : random_tensors(200, 3000, 54)) {
    const auto t = convex_tangent(law, V(tensor.template head<Law::kDimension>()), cloth.history);
    const double least = t.template selfadjointView<Eigen::Lower>().eigenvalues().minCoeff();
    ASSERT_GE(least, -1e-12 * law.largest_stiffness());
  }
}

TEST_P(StepPotential, HasATangentWithoutNegativeStiffness) {
  const auto check = [](const auto& law) { expect_nonnegative(law); };
  with_law<double, 1>(GetParam(), cotton_broad(), kSeconds, check);
  with_law<double, 3>(GetParam(), cotton_broad(), kSeconds, check);
}

}  // namespace
}  // namespace hysteron::testing
