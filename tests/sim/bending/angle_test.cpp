// The dihedral angle and its gradient.  The hinge is drawn in sim/bending/angle.h.
#include "sim/bending/angle.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <array>
#include <random>

namespace hysteron {
namespace {

using Eigen::Vector3d;
using Hinge = std::array<Vector3d, 4>;  // p0, p1, p2, p3

constexpr double kPi = 3.14159265358979323846;
// An angle takes some tens of operations on numbers of order one.
constexpr double kRounding = 1e-13;
// The second term of the error series changes the observed order by about (size of the difference)^2.
constexpr double kOrderSlack = 0.05;

Angle<double> stencil_angle(const Hinge& p) { return dihedral_angle<double>(p[0], p[1], p[2], p[3]); }

// Derivatives of the angle by the four corners, from the two that the code stores.
Hinge gradient(const Angle<double>& a) {
  return {a.g0, a.g1, -(1 - a.t0) * a.g0 - (1 - a.t1) * a.g1, -a.t0 * a.g0 - a.t1 * a.g1};
}

// Returns a hinge with skew triangles, opened to any angle: p0 beside the edge's middle, p1 beyond its end.
Hinge folded(double theta) {
  const double half = theta / 2;
  return {Vector3d(-0.7 * std::cos(half), 0.3, 0.7 * std::sin(half)),
          Vector3d(1.1 * std::cos(half), 1.2, 1.1 * std::sin(half)), Vector3d(0, 0, 0), Vector3d(0, 1, 0)};
}

Hinge random_hinge(std::mt19937& generator) {
  std::uniform_real_distribution<double> shift(-0.25, 0.25), angle(-3, 3);
  Hinge p = folded(angle(generator));
  for (Vector3d& x : p)
    for (int k = 0; k < 3; ++k) x[k] += shift(generator);
  return p;
}

TEST(DihedralAngle, IsPositiveWhereTheFrontIsConcave) {
  for (const double theta : {0.0, 0.1, 1.0, 2.0, 3.1}) {
    EXPECT_NEAR(stencil_angle(folded(theta)).theta, theta, kRounding);
    EXPECT_NEAR(stencil_angle(folded(-theta)).theta, -theta, kRounding);
  }
}

TEST(DihedralAngle, GradientMatchesCentralDifferencesToSecondOrder) {
  std::mt19937 generator(3);
  constexpr double kStep = 1e-3;
  for (int trial = 0; trial < 20; ++trial) {
    const Hinge p = random_hinge(generator);
    const Hinge exact = gradient(stencil_angle(p));
    double error[2] = {0, 0}, size = 0;
    for (int i = 0; i < 4; ++i)
      for (int k = 0; k < 3; ++k) {
        size += exact[i][k] * exact[i][k];
        for (int level = 0; level < 2; ++level) {
          const double h = kStep / (1 << level);
          Hinge plus = p, minus = p;
          plus[i][k] += h;
          minus[i][k] -= h;
          const double here = stencil_angle(p).theta;
          const double difference = (continued_angle(stencil_angle(plus).theta, here) -
                                     continued_angle(stencil_angle(minus).theta, here)) /
                                    (2 * h);
          error[level] += std::pow(difference - exact[i][k], 2);
        }
      }
    ASSERT_GT(size, 1.0);
    EXPECT_NEAR(std::log2(std::sqrt(error[0] / error[1])), 2, kOrderSlack) << trial;
  }
}

TEST(DihedralAngle, GradientHasNoForceAndNoTorque) {
  std::mt19937 generator(5);
  for (int trial = 0; trial < 20; ++trial) {
    const Hinge p = random_hinge(generator), g = gradient(stencil_angle(p));
    Vector3d force = Vector3d::Zero(), torque = Vector3d::Zero();
    double size = 0;
    for (int i = 0; i < 4; ++i) {
      force += g[i];
      torque += p[i].cross(g[i]);
      size += g[i].norm();
    }
    ASSERT_GT(size, 1.0);
    EXPECT_LT(force.norm(), kRounding * size);
    EXPECT_LT(torque.norm(), kRounding * size);
  }
}

TEST(DihedralAngle, KeepsItsValueUnderRigidMotionScalingAndExchangeOfSides) {
  std::mt19937 generator(7);
  const Eigen::AngleAxisd turn(2.2, Vector3d(1, -2, 0.5).normalized());
  const Vector3d shift(0.3, -0.8, 0.2);
  for (int trial = 0; trial < 20; ++trial) {
    const Hinge p = random_hinge(generator);
    Hinge moved, scaled;
    for (int i = 0; i < 4; ++i) {
      moved[i] = turn * p[i] + shift;
      scaled[i] = 0.01 * p[i];
    }
    const double theta = stencil_angle(p).theta;
    EXPECT_NEAR(stencil_angle(moved).theta, theta, 10 * kRounding);
    EXPECT_NEAR(stencil_angle(scaled).theta, theta, 10 * kRounding);
    EXPECT_NEAR(stencil_angle({p[1], p[0], p[3], p[2]}).theta, theta, 10 * kRounding);
  }
}

TEST(ContinuedAngle, FollowsAFoldThroughPlusAndMinusPiForSeveralTurns) {
  constexpr double kStride = 0.05;  // much less than pi between accepted steps
  for (const double direction : {1.0, -1.0}) {
    double accepted = 0;
    for (double theta = 0; theta < 5 * kPi; theta += kStride) {
      accepted = continued_angle(stencil_angle(folded(direction * theta)).theta, accepted);
      ASSERT_NEAR(accepted, direction * theta, 100 * kRounding);
    }
    for (double theta = 5 * kPi; theta > 0; theta -= kStride)
      accepted = continued_angle(stencil_angle(folded(direction * theta)).theta, accepted);
    EXPECT_LT(std::abs(accepted), kStride);
  }
}

TEST(ContinuedAngle, StaysWithinHalfATurnOfThePreviousAngle) {
  for (const double previous : {-9.0, -3.2, 0.0, 3.1, 3.2, 20.0})
    for (double theta = -3.1; theta < 3.15; theta += 0.1) {
      const double continued = continued_angle(theta, previous);
      EXPECT_LE(std::abs(continued - previous), kPi + kRounding);
      EXPECT_NEAR(std::remainder(continued - theta, 2 * kPi), 0, 100 * kRounding);
    }
}

}  // namespace
}  // namespace hysteron
