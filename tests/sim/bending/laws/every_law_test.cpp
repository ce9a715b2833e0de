// Every law, scalar and tensor.  As a function: tangents by observed order, tensors against scalars, residual
// curvature, single precision, extreme fabrics.  Its energy: what is spent is stored or lost, what is lost
// does not come back, and a step's potential has the moment as its derivative and is convex where the model
// says so.
#include <Eigen/Eigenvalues>

#include <numbers>

#include "sim/bending/typed_law_loop.h"
#include "tests/sim/bending/laws/every_law.h"

namespace hysteron::testing {
namespace {

class EveryLaw : public ::testing::TestWithParam<LawCase> {};
INSTANTIATE_TEST_SUITE_P(Laws, EveryLaw, ::testing::ValuesIn(law_cases()), test::CaseName());

double tangent_error(const AnyLaw& law, const Vec<double, 3>& k, double h) {
  Tangent<double, 3> difference;
  for (int a = 0; a < 3; ++a) {
    const Vec<double, 3> along = h * Vec<double, 3>::Unit(a);
    difference.col(a) = (law.step(k + along).moment - law.step(k - along).moment) / (2 * h);
  }
  return (law.tangent(k) - difference).cwiseAbs().maxCoeff();
}

TEST_P(EveryLaw, TangentIsTheDerivativeOfTheMomentToSecondOrder) {
  for_scalar_and_tensor(GetParam(), kSeconds, [](AnyLaw& law) {
    for (const auto& k : law.random_path(5, 2 * kCotton.k0, 41)) law.to(k);
    constexpr double kCoarse = 3e-2, kFine = 3e-3;  // [1/m] nearer than any kink at all but a few points
    int measured = 0, second_order = 0;
    for (const auto& k : law.random_path(60, 2 * kCotton.k0, 42)) {
      const Tangent<double, 3> tangent = law.tangent(k);
      ASSERT_LE((tangent - tangent.transpose()).norm(), 1e-14 * tangent.norm());
      ASSERT_LE(tangent.selfadjointView<Eigen::Lower>().eigenvalues().maxCoeff(),
                law.largest_stiffness() * (1 + 1e-9));
      const double e1 = tangent_error(law, k, kCoarse), e2 = tangent_error(law, k, kFine);
      const double rounding = 1e-15 * law.step(k).moment.norm() / kFine + 1e-9 * kCotton.b2;
      ++measured;
      second_order += e2 < 10 * rounding || std::log10(e1 / e2) > 1.9;
    }
    EXPECT_GE(second_order, 0.9 * measured);  // the others have a kink within 3e-2/m
  });
}

TEST_P(EveryLaw, RadialTensorLawsFollowTheScalarLawOnACylinderInAnyDirection) {
  if (GetParam().slips_on_ellipsoids) GTEST_SKIP() << "spectrum_test.cpp";
  if (any_law(GetParam(), As::kTensor, 0)->runs_along_four_directions())
    GTEST_SKIP() << "tensor_law_test.cpp says how well four directions do";
  constexpr double kRounding = 1e-12;
  for (int direction = 0; direction < 24; ++direction) {
    const double c = std::cos(std::numbers::pi * direction / 24),
                 s = std::sin(std::numbers::pi * direction / 24);
    const Vec<double, 3> bend{c * c, s * s, std::sqrt(2) * c * s};
    const auto sheet = any_law(GetParam(), As::kTensor, kSeconds),
               strip = any_law(GetParam(), As::kScalar, kSeconds);
    for (double k : random_turns(60, 2 * kCotton.k0, 61)) {
      const AnyLaw::Step one = strip->to({k, 0, 0}), all = sheet->to(k * bend);
      ASSERT_LE((all.moment - one.moment[0] * bend).norm(), kRounding * kCotton.b1 * kCotton.k0);
      ASSERT_NEAR(all.stored, one.stored, kRounding * kCotton.b1 * kCotton.k0 * kCotton.k0);
      ASSERT_NEAR(all.dissipated, one.dissipated, kRounding * kCotton.b1 * kCotton.k0 * kCotton.k0);
    }
  }
}

TEST_P(EveryLaw, CarriesNoMomentAtItsResidualCurvature) {
  for_scalar_and_tensor(GetParam(), kSeconds, [](AnyLaw& law) {
    constexpr double kNewton = 1e-9;
    for (const auto& k : law.random_path(100, 3 * kCotton.k0, 7)) {
      law.set_seconds(kSeconds);
      law.to(k);
      law.set_seconds(0);
      ASSERT_LE(law.step(law.residual()).moment.norm(), kNewton * kCotton.b1 * kCotton.k0);
    }
  });
}

TEST_P(EveryLaw, InSinglePrecisionStaysCloseToDouble) {
  const auto fine = any_law(GetParam(), As::kTensor, kSeconds),
             coarse = any_law(GetParam(), As::kTensorInSinglePrecision, kSeconds);
  constexpr double kSingle = 2e-5;  // some hundred roundings of 6e-8
  double lost = 0, lost_in_single = 0;
  for (const auto& k : random_tensors(200, 2 * kCotton.k0, 51)) {
    const Vec<double, 3> here = k.cast<float>().cast<double>();
    const AnyLaw::Step exact = fine->to(here), rough = coarse->to(here);
    ASSERT_LE((exact.moment - rough.moment).norm(), kSingle * kCotton.b1 * kCotton.k0);
    lost += exact.dissipated;
    lost_in_single += rough.dissipated;
  }
  EXPECT_NEAR(lost_in_single, lost, kSingle * 200 * kCotton.friction_moment() * kCotton.k0);
}

void expect_finite(AnyLaw& law, const VirginCurve& c, bool passive) {
  const double largest = 3 * std::max(c.k0, c.friction_moment() / c.b2);
  const double scale = (law.largest_stiffness() * largest + c.friction_moment()) * largest;
  for (const auto& k : random_tensors(200, std::min(largest, 3000.0), 8)) {
    const AnyLaw::Step step = law.to(k);
    ASSERT_TRUE(step.moment.allFinite() && std::isfinite(step.stored) && std::isfinite(step.dissipated));
    if (passive) {
      ASSERT_GE(step.dissipated, -1e-13 * scale);
    }
  }
}

TEST_P(EveryLaw, BehavesOnExtremeFabrics) {
  for (const double b1 : {1e-8, 1e-5, 1e-3})
    for (const double k0 : {1.0, 50.0, 1000.0})
      for (const double ratio : {1.0, 0.3, 1e-6}) {  // b2/b1: elastic, common, M0 >> b2 K0
        const VirginCurve c{b1, ratio * b1, k0};
        SCOPED_TRACE(::testing::Message() << "b1 = " << b1 << ", b2 = " << c.b2 << ", k0 = " << k0);
        LawCase extreme = GetParam();
        if (extreme.parameters.count("fatigue.m-inf")) extreme.parameters["fatigue.m-inf"] = "0";
        if (extreme.law == "spring") extreme.parameters["height"] = std::to_string(1 / k0);
        for (const As as : {As::kScalar, As::kTensor})
          expect_finite(*any_law(extreme, as, kSeconds, c), c, extreme.passive);
      }
}

TEST_P(EveryLaw, ButWongNeverGivesBackWhatItLost) {
  const double rounding = 1e-14 * kCotton.b1 * 4 * kCotton.k0 * kCotton.k0;
  for (unsigned seed = 1; seed <= 5; ++seed)
    for_scalar_and_tensor(GetParam(), kSeconds, [&](AnyLaw& law) {
      for (const auto& k : random_tensors(2000, 2 * kCotton.k0, seed)) {
        const AnyLaw::Step step = law.to(k);
        ASSERT_GE(step.stored, 0);
        if (GetParam().passive) {
          ASSERT_GE(step.dissipated, -rounding);
        }
      }
    });
}

// |int M dK - stored - dissipated| along straight pieces by the trapezium rule; the whole way takes 10 s.
double balance_error(AnyLaw& law, const Path& corners, int pieces) {
  constexpr double kWholePath = 10;
  law.set_seconds(kWholePath / (static_cast<double>(corners.size()) * pieces));
  Vec<double, 3> at = Vec<double, 3>::Zero(), moment = at;
  double work = 0, stored = 0, dissipated = 0;
  for (const auto& corner : corners) {
    const Vec<double, 3> way = (corner - at) / pieces;
    for (int i = 1; i <= pieces; ++i) {
      const AnyLaw::Step step = law.to(at + way * i);
      work += (moment + step.moment).dot(way) / 2;
      moment = step.moment;
      stored = step.stored;
      dissipated += step.dissipated;
    }
    at = corner;
  }
  return std::abs(work - stored - dissipated);
}

// Steps fine enough for laws that stick and slip: below, their error depends on where in a step they slip.
TEST_P(EveryLaw, StoresOrLosesTheWorkDoneAlongFinePaths) {
  const double scale = kCotton.friction_moment() * kCotton.k0;
  for (const As as : {As::kScalar, As::kTensor}) {
    const auto error = [&](int pieces) {
      const auto law = any_law(GetParam(), as, 0);
      return balance_error(*law, law->random_path(6, 2 * kCotton.k0, 4), pieces);
    };
    const double coarse = error(4000), fine = error(32000);
    constexpr double kFirstOrder = 0.8, kQuadratureRounding = 1e-10;
    EXPECT_LE(coarse, 0.1 * scale);
    if (fine > kQuadratureRounding * scale) {
      EXPECT_GE(std::log(coarse / fine) / std::log(8), kFirstOrder);
    }
  }
}

TEST(EnergyBalance, HoldsToSecondOrderForABoundedStackThatDropsPairs) {
  Path corners;
  for (double k : random_turns(60, 2 * kCotton.k0, 12)) corners.push_back({k, 0, 0});
  const auto error = [&](int pieces) {
    const auto law = any_law({"", "prandtl", {{"memory", "stack"}, {"stack", "4"}}}, As::kScalar, 0);
    return balance_error(*law, corners, pieces);
  };
  const double coarse = error(400), fine = error(1600);
  EXPECT_LE(coarse, 0.1 * kCotton.friction_moment() * kCotton.k0);
  EXPECT_GE(std::log2(coarse / fine) / 2, 1.75);
}

// Stored and dissipated of a step from one state are its potential: their slope is the moment, which
// increases along any way.  Creep and fatigue lose energy at the end of a step, beside the potential.
TEST_P(EveryLaw, StoresAndLosesAConvexPotentialWithinAStep) {
  const bool late_losses = GetParam().name.ends_with("fatigue") || GetParam().timed;
  for_scalar_and_tensor(GetParam(), kSeconds, [&](AnyLaw& law) {
    for (const auto& k : law.random_path(7, 1.5 * kCotton.k0, 30)) law.to(k);
    const double step = kCotton.k0 / 37,  // 37: unrelated to any threshold
        rounding = 1e-12 * kCotton.b1 * kCotton.k0 * kCotton.k0;
    const Vec<double, 3> way = step * law.component(Vec<double, 3>::Ones());
    for (const auto& here : law.random_path(100, 2 * kCotton.k0, 31)) {
      const auto at = [&](double t) { return law.step(here + t * way); };
      ASSERT_GE(at(1).moment.dot(way) - at(-1).moment.dot(way), -rounding);
      if (late_losses) continue;
      const double h = 1e-4, rise = at(h).stored + at(h).dissipated - at(-h).stored - at(-h).dissipated;
      ASSERT_NEAR(rise / (2 * h), at(0).moment.dot(way),
                  2 * law.largest_stiffness() * way.squaredNorm() * h + rounding / h);
    }
  });
}

// Measurements evaluate the law again where it is; they must find what the step left.
TEST_P(EveryLaw, IsFoundAsItWasLeft) {
  for_scalar_and_tensor(GetParam(), kSeconds, [](AnyLaw& law) {
    const double rounding = 1e-12 * kCotton.b1 * kCotton.k0 * kCotton.k0;
    law.set_seconds(0);
    for (const auto& k : random_tensors(200, 2 * kCotton.k0, 5)) {
      const double stored = law.to(k).stored;
      ASSERT_NEAR(law.step(k).stored, stored, rounding);
      ASSERT_NEAR(law.step(k).dissipated, 0, rounding);
    }
  });
}

// Returns |W(k + h d) - W(k - h d) - 2 h M.d|.
double quotient_error(const AnyLaw& law, const Vec<double, 3>& k, const Vec<double, 3>& d, double h) {
  return std::abs(law.potential(k + h * d) - law.potential(k - h * d) - 2 * h * law.step(k).moment.dot(d));
}

TEST_P(EveryLaw, HasAPotentialWhoseDerivativeIsTheMoment) {
  for_scalar_and_tensor(GetParam(), kSeconds, [](AnyLaw& law) {
    const double largest = 3 * kCotton.k0;
    for (const auto& k : law.random_path(7, largest, 51)) law.to(k);
    const Vec<double, 3> d = law.component(Vec<double, 3>::Ones()).normalized();
    constexpr double kCoarse = 1e-1, kFine = 1e-2;  // [1/m]
    int third_order = 0, measured = 0;
    for (const auto& k : law.random_path(60, largest, 52)) {
      ASSERT_GT(law.step(k).moment.norm(), 0);
      const double e1 = quotient_error(law, k, d, kCoarse), e2 = quotient_error(law, k, d, kFine);
      const double rounding = 1e-15 * std::abs(law.potential(k)) + 1e-18;
      ++measured;
      third_order += e2 < 20 * rounding || std::log10(e1 / e2) > 2.8;
    }
    EXPECT_GE(third_order, 0.85 * measured);  // the others have a kink of the tangent within 0.1/m
  });
}

// Returns the least (M(a) - M(b)).(a - b)/|a - b|^2 over random pairs [N m].
double least_secant(const AnyLaw& law, double largest) {
  const Path points = law.random_path(200, largest, 53);
  double least = 1e30;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const Vec<double, 3> a = points[i], b = points[i + 1];
    least = std::min(least, (law.step(a).moment - law.step(b).moment).dot(a - b) / (a - b).squaredNorm());
  }
  return least;
}

TEST_P(EveryLaw, HasAConvexPotentialSoThatTheMomentIsMonotone) {
  // sin-shaped moments fall beyond their crest: 180 degrees of a hinge of 5 mm are 628/m.
  const bool falls_beyond_the_crest = GetParam().law == "bridson" || GetParam().law == "spring";
  for_scalar_and_tensor(GetParam(), kSeconds, [&](AnyLaw& law) {
    const double largest = 3 * kCotton.k0;
    for (const auto& k : law.random_path(7, largest, 51)) law.to(k);
    EXPECT_GE(least_secant(law, largest), -1e-12);
    EXPECT_EQ(least_secant(law, 20 * largest) < -1e-12, falls_beyond_the_crest);
  });
}

TEST_P(EveryLaw, HasATangentWithoutNegativeStiffness) {
  for_scalar_and_tensor(GetParam(), kSeconds, [](AnyLaw& law) {
    for (const auto& k : law.random_path(7, 3000, 51)) law.to(k);
    for (const auto& k : law.random_path(200, 3000, 54)) {
      const Tangent<double, 3> t = law.convex_tangent(k);
      ASSERT_GE(t.selfadjointView<Eigen::Lower>().eigenvalues().minCoeff(), -1e-12 * law.largest_stiffness());
    }
  });
}

template <int N>
struct Remembering {
  static constexpr int kHistory = N;
};

template <int N>
void expect_round_trip() {
  constexpr int kElements = 5;
  std::vector<double> memory(kElements * N);
  std::vector<History<double, N>> histories(kElements);
  for (int i = 0; i < kElements; ++i) {
    for (int k = 0; k < N; ++k) histories[i][k] = 100 * i + k + 1;
    store_history<Remembering<N>>(memory.data(), i, kElements, histories[i]);
  }
  for (int i = 0; i < kElements; ++i) {
    const auto back = load_history<Remembering<N>>(memory.data(), i, kElements);
    for (int k = 0; k < N; ++k) ASSERT_EQ(back[k], histories[i][k]);
  }
}

TEST(HistoryOfALaw, ComesBackFromMemoryAsItWas) {
  expect_round_trip<1>();
  expect_round_trip<4>();
  expect_round_trip<37>();
}

}  // namespace
}  // namespace hysteron::testing
