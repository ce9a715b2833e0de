// These tests check the kind of obstacle from the worked example in docs/developing.md.
#include <gtest/gtest.h>

#include "sim/contact/signed_distance.h"

namespace hysteron {
#include "tests/examples/obstacle/pole.h"
namespace {

constexpr double kRounding = 1e-14;
const Shape<double> kPole{ObstacleKind::pole, {0.5, 0.5, 0.1}, 0};

TEST(PoleExample, IsOneRowWithItsNameAndHalfThickness) {
  struct {
    ObstacleKind kind = ObstacleKind::pole;
    double radius = 0.5, height = 0.2;
    Vec3<double> size{1, 1, 1};
  } o;
  EXPECT_STREQ(names(o.kind)[static_cast<std::size_t>(o.kind)], "pole");
  EXPECT_EQ(names(o.kind).size(), 9u);
  EXPECT_DOUBLE_EQ(obstacle_form(o).half_thickness, 0.5);
  EXPECT_TRUE(obstacle_form(o).has_axis);
  EXPECT_FALSE(obstacle_form(o).has_rim);
}

TEST(PoleExample, IsReachedByTheSignedDistanceOfItsKind) {
  EXPECT_NEAR(signed_distance(kPole, Vec3<double>(0.6 * 1.5, 0.8 * 1.5, 7)).value, 1, kRounding);
  EXPECT_NEAR(signed_distance(kPole, Vec3<double>(0, 0.45, -7)).value, -0.05, kRounding);
  EXPECT_EQ(signed_distance(kPole, Vec3<double>(0, 0.45, 0)).normal, (Vec3<double>(0, 1, 0)));
  EXPECT_NEAR(signed_distance(kPole, Vec3<double>(0, 0, 3)).normal.norm(), 1, kRounding);  // on the axis
}

}  // namespace
}  // namespace hysteron
