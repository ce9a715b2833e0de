// Laws on the curvature tensor: cylinders follow the scalar law, turning the cloth turns the moment.
#include <gtest/gtest.h>

#include <numbers>

#include "sim/bending/laws/four_directions.h"
#include "sim/bending/laws/linear.h"
#include "sim/bending/laws/pabst.h"
#include "sim/bending/laws/prandtl_stack.h"
#include "sim/bending/laws/prandtl_stops.h"
#include "sim/bending/laws/wong.h"
#include "tests/sim/bending/laws/law_fixtures.h"

namespace hysteron::testing {
namespace {

// Returns the unit curvature of a cylinder bent in the direction `angle`, as (S_xx, S_yy, sqrt2 S_xy).
Vec<double, 3> cylinder(double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return {c * c, s * s, std::sqrt(2) * c * s};
}

// The rotation of (S_xx, S_yy, sqrt2 S_xy) when the cloth turns by `angle`; orthogonal.
Eigen::Matrix3d turned(double angle) {
  const double c = std::cos(angle), s = std::sin(angle), r = std::sqrt(2);
  Eigen::Matrix3d q;
  q << c * c, s * s, -r * c * s, s * s, c * c, r * c * s, r * c * s, -r * c * s, c * c - s * s;
  return q;
}

template <class Law>
void expect_isotropic(const Law& law) {
  constexpr double kRounding = 1e-13;
  const Eigen::Matrix3d q = turned(0.37);
  ASSERT_LE((q.transpose() * q - Eigen::Matrix3d::Identity()).norm(), kRounding);
  Driven<Law> sheet(law), rotated(law);
  for (const auto& s : random_tensors(100, 2 * kCotton.k0, 62)) {
    const Vec<double, 3> m = sheet.to(s).moment;
    ASSERT_LE((rotated.to(Vec<double, 3>(q * s)).moment - q * m).norm(), kRounding * kCotton.b1 * kCotton.k0);
    ASSERT_NEAR(rotated.last.stored, sheet.last.stored, kRounding * kCotton.b1 * kCotton.k0 * kCotton.k0);
  }
}

TEST(TensorLaw, TurningTheClothTurnsTheMoment) {
  expect_isotropic(Pabst<double, 3>::make(kCotton));
  expect_isotropic(PrandtlStops<double, 3, 8>::make(kCotton));
}

TEST(FourDirections, OfALinearLawAreAnIsotropicPlate) {
  const auto law = FourDirections<Linear<double, 1>>::make(kCotton);
  const Eigen::Matrix3d tangent = law.tangent(Vec<double, 3>::Zero(), {});
  constexpr double kRounding = 1e-14, kFrame = 1e-3;  // omega s^2 (1 - beta)^2/4 = 0.9995
  EXPECT_LE((tangent - tangent(0, 0) * Eigen::Matrix3d::Identity()).norm(), kRounding * tangent.norm());
  EXPECT_NEAR(tangent(0, 0), kCotton.b2, kFrame * kCotton.b2);
  EXPECT_NEAR(law.largest_stiffness(), tangent(0, 0), kRounding * kCotton.b2);
}

TEST(FourDirections, StandAtTwentyTwoAndAHalfDegreesWithTheirWeights) {
  using Law = FourDirections<Linear<double, 1>>;
  const double beta = -std::pow(std::sqrt(2) - 1, 2);
  constexpr double kRounding = 1e-15;
  for (int d = 0; d < 4; ++d) {
    const double angle = std::numbers::pi * (22.5 + 45 * d) / 180;
    const Vec<double, 3> w = Law::kScale * (cylinder(angle) + beta * cylinder(angle + std::numbers::pi / 2));
    EXPECT_LE((Law::direction(d) - w).norm(), 4 * kRounding);
  }
}

// Returns the largest error of M.nu on a cylinder swept to +-3 K0, relative to the largest scalar moment.
template <class Tensor, class Scalar>
double worst_bend_error(const Tensor& tensor, const Scalar& scalar, const VirginCurve& c, double angle) {
  Driven<Tensor> sheet(tensor);
  Driven<Scalar> strip(scalar);
  const Vec<double, 3> bend = cylinder(angle);
  double worst = 0, largest = 0;
  for (int i = 1; i <= 150; ++i) {
    const double wave = i <= 30 ? i / 30. : i <= 90 ? 2 - i / 30. : i / 30. - 4, k = 3 * c.k0 * wave;
    const double m = strip.moment(k);
    worst = std::max(worst, std::abs(sheet.to(Vec<double, 3>(k * bend)).moment.dot(bend) - m));
    largest = std::max(largest, std::abs(m));
  }
  return worst / largest;
}

template <class Tensor, class Scalar>
void expect_bends_within_claims(const Tensor& tensor, const Scalar& scalar, const VirginCurve& c) {
  constexpr double kAligned = 0.004;
  for (double angle : {0.0, std::numbers::pi / 4, std::numbers::pi / 2, 3 * std::numbers::pi / 4})
    EXPECT_LE(worst_bend_error(tensor, scalar, c, angle), kAligned);
  // Only friction is overrated, and by no more than in the direction of one of the four.
  const double excess = Tensor::kWeight * Tensor::kScale / 2 - 1;
  const double bound = excess * c.friction_moment() / (c.friction_moment() + 3 * c.b2 * c.k0);
  for (int i = 0; i < 48; ++i)
    EXPECT_LE(worst_bend_error(tensor, scalar, c, std::numbers::pi * i / 48), bound);
}

TEST(FourDirections, FollowTheScalarLawWithinFourPermilleAlignedAndOverrateFrictionInBetween) {
  expect_bends_within_claims(FourDirections<Wong<double>>::make(kCotton), Wong<double>::make(kCotton),
                             kCotton);
  expect_bends_within_claims(FourDirections<PrandtlStack<double, 8>>::make(kCotton),
                             PrandtlStack<double, 8>::make(kCotton), kCotton);
}

TEST(FourDirections, SaturateAtAFrictionThatDependsOnTheDirection) {
  const VirginCurve c{1e-5, 0, 50};
  const auto law = FourDirections<PrandtlStack<double, 8>>::make(c);
  using Law = FourDirections<PrandtlStack<double, 8>>;
  constexpr double kRounding = 1e-12;
  const double s = Law::kScale, omega = Law::kWeight, bent = 100 * c.k0;
  const auto friction = [&](double angle) {
    return law.step(Vec<double, 3>(bent * cylinder(angle)), {}).moment.dot(cylinder(angle)) /
           c.friction_moment();
  };
  EXPECT_NEAR(friction(0), omega * s * (std::sqrt(2) - 1), kRounding);  // 1.0037
  EXPECT_NEAR(friction(std::numbers::pi / 4), omega * s * (std::sqrt(2) - 1), kRounding);
  EXPECT_NEAR(friction(std::numbers::pi / 8), omega * s / 2,
              kRounding);  // 1.2116: no s and omega make both 1
}

}  // namespace
}  // namespace hysteron::testing
