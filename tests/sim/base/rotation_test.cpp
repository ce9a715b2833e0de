// These tests check rotations from one direction to another.
#include "sim/base/rotation.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

namespace hysteron {
namespace {

constexpr double kRounding = 1e-14;

TEST(Rotation, TakesOneDirectionToTheOtherByTheLeastAngle) {
  const Eigen::Vector3d from(1, 2, -0.5), to(-3, 1, 4);
  const Eigen::Matrix3d turn = rotation_between(from, to);
  EXPECT_LT((turn * from.normalized() - to.normalized()).norm(), kRounding);
  const double angle = std::acos(from.normalized().dot(to.normalized()));
  EXPECT_NEAR(Eigen::AngleAxisd(turn).angle(), angle, kRounding);
  const Eigen::Vector3f z = Eigen::Vector3f::UnitZ(), light(1, -1, 2);
  EXPECT_LT((rotation_between(light, z) * light.normalized() - z).norm(), 1e-6f);
}

TEST(Rotation, OfOppositeDirectionsIsAHalfTurn) {
  const Eigen::Vector3d from(0.3, -2, 1);
  const Eigen::Matrix3d turn = rotation_between(from, Eigen::Vector3d(-from));
  EXPECT_LT((turn * from + from).norm(), 1e-7);  // of the square root of rounding
  EXPECT_NEAR(turn.determinant(), 1, kRounding);
  EXPECT_NEAR(turn.trace(), -1, kRounding);
}

}  // namespace
}  // namespace hysteron
