// Signed distances of the obstacles' shapes.
#include "sim/contact/signed_distance.h"

#include <gtest/gtest.h>

#include <random>

namespace hysteron {
namespace {

using Eigen::Vector3d;
using Solid = Shape<double>;

constexpr double kRounding = 1e-14;  // a few operations on lengths of order one
constexpr double kRadius = 0.5, kHalfHeight = 0.3, kRim = 0.05;

const Solid kGround{ObstacleKind::ground, Vector3d::Zero(), 0};
const Solid kSphere{ObstacleKind::sphere, Vector3d::Constant(kRadius), 0};
const Solid kCylinder{ObstacleKind::cylinder, Vector3d(kRadius, kRadius, kHalfHeight), kRim};
const Solid kBox{ObstacleKind::box, Vector3d(0.5, 0.4, 0.3), kRim};
const Solid kCapsule{ObstacleKind::capsule, Vector3d(kRadius, kRadius, kHalfHeight), 0};
const Solid kTorus{ObstacleKind::torus, Vector3d(kRadius, kRadius, 0.1), 0};

double distance(const Solid& s, const Vector3d& p) { return signed_distance(s, p).value; }

TEST(SignedDistance, OfSimpleShapesIsTheirFormula) {
  EXPECT_EQ(distance(kGround, {3, -2, 0.7}), 0.7);
  EXPECT_NEAR(distance(kSphere, {1, 2, 2}), 3 - kRadius, kRounding);
  EXPECT_NEAR(distance(kSphere, {0.1, 0, 0}), 0.1 - kRadius, kRounding);
  EXPECT_NEAR(distance(kCapsule, {0.3, 0.4, 0.2}), 0.5 - kRadius, kRounding);              // beside the axis
  EXPECT_NEAR(distance(kCapsule, {0.6, 0, kHalfHeight + 0.8}), 1.0 - kRadius, kRounding);  // beyond its end
}

TEST(SignedDistance, OfCylinderAndBoxIsToTheNearestFaceAwayFromTheRim) {
  EXPECT_NEAR(distance(kCylinder, {0.6, 0.8, 0.1}), 1 - kRadius, kRounding);
  EXPECT_NEAR(distance(kCylinder, {0.1, 0.1, 0.9}), 0.9 - kHalfHeight, kRounding);
  EXPECT_NEAR(distance(kCylinder, {0.1, 0.1, -0.9}), 0.9 - kHalfHeight, kRounding);
  EXPECT_NEAR(distance(kCylinder, {0, 0.01, 0.25}), 0.25 - kHalfHeight, kRounding);  // inside, under the lid
  EXPECT_NEAR(distance(kBox, {0.9, 0.1, -0.1}), 0.4, kRounding);
  EXPECT_NEAR(distance(kBox, {0.1, -0.6, 0.1}), 0.2, kRounding);
  EXPECT_NEAR(distance(kBox, {0.45, 0, 0}), -0.05, kRounding);
}

// Beyond an edge the surface is a quarter circle of the rim's radius about its centre.
TEST(SignedDistance, OfRoundedEdgesIsToTheRimsCircle) {
  const double inner = kRadius - kRim, lid = kHalfHeight - kRim;
  EXPECT_NEAR(distance(kCylinder, {inner + 0.3, 0, lid + 0.4}), 0.5 - kRim, kRounding);
  EXPECT_NEAR(distance(kBox, {0.45 + 0.3, 0.35 + 0.4, 0}), 0.5 - kRim, kRounding);
  EXPECT_NEAR(distance(kBox, {0.45 + 0.2, 0.35 + 0.2, 0.25 + 0.1}), 0.3 - kRim, kRounding);
}

TEST(SignedDistance, OfTheTorusIsToTheCircleInItsWireLessTheWiresRadius) {
  EXPECT_NEAR(distance(kTorus, {0.6 * 1.5, 0.8 * 1.5, 0}), 1 - 0.1, kRounding);  // outside, in its plane
  EXPECT_NEAR(distance(kTorus, {0, kRadius, 0.3}), 0.3 - 0.1, kRounding);        // above the wire
  EXPECT_NEAR(distance(kTorus, {0, kRadius - 0.3, 0.4}), 0.5 - 0.1, kRounding);  // beside and above it
  EXPECT_NEAR(distance(kTorus, {0, 0.45, 0}), 0.05 - 0.1, kRounding);            // in the wire
  EXPECT_NEAR(distance(kTorus, {0, 0, 0}), kRadius - 0.1, kRounding);            // in the hole
}

TEST(SignedDistance, NormalIsTheUnitGradientToSecondOrder) {
  std::mt19937 generator(6);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (const Solid& s : {kGround, kSphere, kCylinder, kBox, kCapsule, kTorus}) {
    double error[2] = {0, 0};
    for (int trial = 0; trial < 200; ++trial) {
      const Vector3d p(uniform(generator), uniform(generator), uniform(generator));
      if (distance(s, p) < 0.01) continue;  // outside, where the distance is smooth
      const Vector3d n = signed_distance(s, p).normal;
      ASSERT_NEAR(n.norm(), 1, kRounding);
      for (int level = 0; level < 2; ++level) {
        const double h = 2e-4 / (1 << level);
        Vector3d gradient;
        for (int k = 0; k < 3; ++k) {
          const Vector3d d = h * Vector3d::Unit(k);
          gradient[k] = (distance(s, p + d) - distance(s, p - d)) / (2 * h);
        }
        error[level] = std::max(error[level], (gradient - n).norm());
      }
    }
    constexpr double kLevel = 1e-3;  // h/rim: pieces of the surface join with a jump of curvature
    EXPECT_LT(error[0], kLevel);
    EXPECT_LT(error[1], kLevel);
  }
}

// Walking around a rim crosses three pieces; the normal turns without a jump and the distance stays at zero.
TEST(SignedDistance, NormalTurnsSmoothlyAroundTheRim) {
  constexpr int kSteps = 2000;
  constexpr double kPath = 0.2;
  const double inner = kRadius - kRim, lid = kHalfHeight - kRim, quarter = kRim * std::acos(0.0);
  for (const Solid& s : {kCylinder, Solid{ObstacleKind::box, kCylinder.half, kRim}}) {
    Vector3d last = Vector3d::UnitZ();
    for (int i = 0; i <= kSteps; ++i) {
      const double walked =
          (2 * kPath + quarter) * i / kSteps - kPath;  // over the lid, around, down the side
      const double turn = std::min(std::max(walked, 0.0), quarter) / kRim;
      Vector3d p(inner + kRim * std::sin(turn), 0, lid + kRim * std::cos(turn));
      if (walked < 0) p.x() += walked;
      if (walked > quarter) p.z() -= walked - quarter;
      const auto d = signed_distance(s, p);
      EXPECT_NEAR(d.value, 0, 10 * kRounding);
      EXPECT_LT((d.normal - last).norm(), 1.01 * (2 * kPath + quarter) / kSteps / kRim) << walked;
      last = d.normal;
    }
    EXPECT_NEAR(last.x(), 1, kRounding);
  }
}

TEST(SignedDistance, HasAnOutwardNormalEvenAtTheCentre) {
  for (const Solid& s : {kSphere, kCylinder, kBox, kCapsule}) {
    const auto d = signed_distance<double>(s, Vector3d::Zero());
    EXPECT_LT(d.value, 0);
    EXPECT_NEAR(d.normal.norm(), 1, kRounding);
  }
}

TEST(SignedDistance, ChangesNoFasterThanThePointMoves) {
  std::mt19937 generator(7);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const auto point = [&] { return Vector3d(uniform(generator), uniform(generator), uniform(generator)); };
  for (const Solid& s : {kGround, kSphere, kCylinder, kBox, kCapsule, kTorus})
    for (int trial = 0; trial < 1000; ++trial) {
      const Vector3d p = point(), q = p + 0.1 * point();
      EXPECT_LE(std::abs(distance(s, p) - distance(s, q)), (p - q).norm() + kRounding);
    }
}

}  // namespace
}  // namespace hysteron
