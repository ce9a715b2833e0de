// A kind of obstacle from the worked example in docs/developing.md.
#include <gtest/gtest.h>

#include "sim/contact/signed_distance.h"

namespace hysteron {
#include "tests/examples/obstacle/torus.h"
namespace {

constexpr double kRounding = 1e-14;
const Shape<double> kTorus{ObstacleKind::torus, {0.5, 0.5, 0.1}, 0};

TEST(TorusExample, IsOneRowWithItsNameAndHalfThickness) {
  struct {
    ObstacleKind kind = ObstacleKind::torus;
    double radius = 0.5, height = 0.2;
    Vec3<double> size{1, 1, 1};
  } o;
  EXPECT_STREQ(names(o.kind)[static_cast<std::size_t>(o.kind)], "torus");
  EXPECT_EQ(names(o.kind).size(), 7u);
  EXPECT_DOUBLE_EQ(form_of(o).half_thickness, 0.1);
  EXPECT_TRUE(form_of(o).has_axis);
  EXPECT_FALSE(form_of(o).has_rim);
}

TEST(TorusExample, IsReachedByTheSignedDistanceOfItsKind) {
  EXPECT_NEAR(signed_distance(kTorus, Vec3<double>(0.6 * 1.5, 0.8 * 1.5, 0)).value, 0.9, kRounding);
  EXPECT_NEAR(signed_distance(kTorus, Vec3<double>(0, 0.5, 0.3)).value, 0.2, kRounding);
  EXPECT_NEAR(signed_distance(kTorus, Vec3<double>(0, 0.45, 0)).value, -0.05, kRounding);  // inside the tube
  EXPECT_NEAR(signed_distance(kTorus, Vec3<double>(0, 0, 0)).value, 0.4, kRounding);       // in the hole
}

}  // namespace
}  // namespace hysteron
