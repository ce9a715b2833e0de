#include "render/camera.h"

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "tests/render/test_scene.h"

namespace hysteron::render {
namespace {

constexpr float kRounding = 1e-4f;  // single precision through two matrices, coordinates of order one

Eigen::Vector3f projected(const Camera& camera, float aspect, const Eigen::Vector3f& point) {
  const Eigen::Vector4f clip = camera.projection(aspect) * camera.view() * point.homogeneous();
  return clip.head<3>() / clip.w();
}

TEST(Camera, TargetIsInTheMiddleAndUpIsUp) {
  const Camera camera = Camera::perspective({1, -2, 1}, {0.1f, 0.2f, 0.3f}, 30);
  EXPECT_NEAR(projected(camera, 1.5f, {0.1f, 0.2f, 0.3f}).head<2>().norm(), 0, kRounding);
  EXPECT_GT(projected(camera, 1.5f, {0.1f, 0.2f, 0.4f}).y(), 0.01f);
}

// A point at distance d that is d * tan(fov / 2) above the axis meets the picture's upper edge.
TEST(Camera, FieldOfViewIsTheFullVerticalAngle) {
  const Camera camera = Camera::perspective({0, -2, 0}, {0, 0, 0}, 40);
  const float edge = 2 * std::tan(20 * std::numbers::pi_v<float> / 180);
  EXPECT_NEAR(projected(camera, 1, {0, 0, edge}).y(), 1, kRounding);
  EXPECT_NEAR(projected(camera, 2, {edge, 0, 0}).x(), 0.5f, kRounding);
  EXPECT_NEAR(camera.metres_per_pixel({0, 0, 0}, 100), 2 * edge / 100, kRounding);
}

// The whole box is in the picture, with little room around it.
void expect_framed(const Box& box, const Eigen::Vector3f& direction, float fov, float aspect) {
  const Camera camera = Camera::framing(box, direction, fov, aspect);
  float reach = 0;
  for (int i = 0; i < 8; ++i) {
    const Eigen::Vector3f corner(i & 1 ? box.low.x() : box.high.x(), i & 2 ? box.low.y() : box.high.y(),
                                 i & 4 ? box.low.z() : box.high.z());
    const Eigen::Vector3f shown = projected(camera, aspect, corner);
    reach = std::max(reach, shown.head<2>().cwiseAbs().maxCoeff());
    EXPECT_LT(std::abs(shown.z()), 1) << "cut off by the near or far plane";
  }
  EXPECT_LE(reach, 1.0f);
  EXPECT_GE(reach, 0.9f);
}

TEST(Camera, FramingKeepsTheWholeBoxAndWastesLittle) {
  const Box box{{-0.2f, -0.1f, 0}, {0.3f, 0.2f, 0.25f}};
  for (const Eigen::Vector3f& direction : {Eigen::Vector3f(0.4f, -1, 0.5f), Eigen::Vector3f(0, 0, 1),
                                           Eigen::Vector3f(-1, 0, 0), Eigen::Vector3f(1, 1, -0.3f)})
    for (const float aspect : {0.6f, 1.0f, 16.0f / 9}) expect_framed(box, direction, 25, aspect);
}

TEST(Camera, FramesPointsWithinItsBorder) {
  const Camera camera = Camera::perspective({0, -2, 0}, {0, 0, 0}, 40);
  const float edge = 2 * std::tan(20 * std::numbers::pi_v<float> / 180);
  const auto frames = [&](const Eigen::Vector3f& point) {
    const std::vector<float> points = {0, 0, 0, point.x(), point.y(), point.z()};
    return camera.frames(points, 2);
  };
  EXPECT_TRUE(frames({1.99f * edge, 0, 0.99f * edge}));
  EXPECT_FALSE(frames({2.01f * edge, 0, 0}));
  EXPECT_FALSE(frames({0, 0, -1.01f * edge}));
  EXPECT_FALSE(frames({0, -3, 0})) << "behind the eye";
}

// A strip, a disc without thickness and a tall box are framed from all sides, in wide and narrow pictures.
TEST(Camera, FramingHoldsExtremeShapes) {
  const Box boxes[] = {{{-0.5f, -0.005f, 0}, {0.5f, 0.005f, 0.0001f}},
                       {{-0.15f, -0.15f, 0.1f}, {0.15f, 0.15f, 0.1f}},
                       {{-0.05f, -0.05f, 0}, {0.05f, 0.05f, 2}}};
  for (const Box& box : boxes)
    for (const Eigen::Vector3f& direction :
         {Eigen::Vector3f(0.8f, -1.6f, 0.9f), Eigen::Vector3f(0, 0, 1), Eigen::Vector3f(1, 0, 0),
          Eigen::Vector3f(0, -1, 0), Eigen::Vector3f(0, 0, -1), Eigen::Vector3f(1, 0, 0.02f)})
      for (const float aspect : {0.25f, 1.0f, 4.0f}) expect_framed(box, direction, 28, aspect);
}

// However the points lie, they touch two opposite borders but for the margin, and none is beyond.
TEST(Camera, AroundPointsTheyTouchTheBordersOfTheirPicture) {
  std::vector<float> points;
  for (int i = 0; i < 200; ++i) {
    const float t = 0.1f * static_cast<float>(i);
    points.insert(points.end(), {0.1f * std::cos(t), 0.03f * std::sin(3 * t), 0.004f * t});
  }
  for (const Eigen::Vector3f& direction :
       {Eigen::Vector3f(-0.1f, -1, 0.45f), Eigen::Vector3f(0, 0, 1), Eigen::Vector3f(1, 0.2f, 0)})
    for (const float aspect : {0.7f, 1.0f, 2.4f}) {
      const float margin = 0.06f;
      const Window at = Camera::around(points, direction, 22, aspect, margin).image_window(points, aspect);
      const double width = at.right - at.left, height = at.top - at.bottom;
      EXPECT_NEAR(std::max(width, height), 1 - 2 * margin, 1e-4);
      EXPECT_NEAR(width > height ? at.left + at.right : at.bottom + at.top, 1, 1e-3);
      EXPECT_GE(std::min(at.left, at.bottom), margin - 1e-4);
      EXPECT_LE(std::max(at.right, at.top), 1 - margin + 1e-4);
    }
}

TEST(Camera, TopViewHasXRightYUpAndOneScale) {
  const Camera camera = Camera::top({{-0.3f, -0.15f, 0}, {0.3f, 0.15f, 0.1f}}, 1.5f);
  EXPECT_TRUE(camera.is_orthographic());
  EXPECT_GT(projected(camera, 1.5f, {0.1f, 0, 0}).x(), 0);
  EXPECT_GT(projected(camera, 1.5f, {0, 0.1f, 0}).y(), 0);
  EXPECT_LE(projected(camera, 1.5f, {0.3f, 0.15f, 0.1f}).head<2>().maxCoeff(), 1);
  EXPECT_EQ(camera.metres_per_pixel({0, 0, 0}, 200), camera.metres_per_pixel({0.1f, 0, 0.1f}, 200));
  // A length of 0.1 m spans 0.1 / metres_per_pixel of 200 pixels, and the picture's height spans 2 clip
  // units.
  const float span = projected(camera, 1.5f, {0, 0.1f, 0}).y() - projected(camera, 1.5f, {0, 0, 0.1f}).y();
  EXPECT_NEAR(span / 2 * 200, 0.1f / camera.metres_per_pixel({0, 0, 0}, 200), 200 * kRounding);
}

// The left upper quarter of a picture: its corners are the picture's corner, two edges' middles and the
// centre.
TEST(Camera, AWindowShowsItsPartOfThePicture) {
  const Eigen::Vector3f point(0.11f, 0.07f, 0.05f);
  const Window quarter{0, 0.5, 0.5, 1};
  for (const Camera& camera : {Camera::perspective({1, -2, 1}, {0.1f, 0.2f, 0.3f}, 30),
                               Camera::top({{-0.3f, -0.15f, 0}, {0.3f, 0.15f, 0.1f}}, 1.5f)}) {
    const Eigen::Vector3f whole = projected(camera, 1.5f, point);
    const Eigen::Vector4f clip = camera.projection(1.5f, quarter) * camera.view() * point.homogeneous();
    const Eigen::Vector3f part = clip.head<3>() / clip.w();
    EXPECT_NEAR(part.x(), 2 * whole.x() + 1, 4 * kRounding);
    EXPECT_NEAR(part.y(), 2 * whole.y() - 1, 4 * kRounding);
    EXPECT_NEAR(part.z(), whole.z(), kRounding);
    EXPECT_EQ(camera.projection(1.5f, Window{}), camera.projection(1.5f));
  }
}

TEST(Camera, ImpossibleViewsAreRefused) {
  EXPECT_EQ(thrown_error([] { Camera::perspective({0, 0, 0}, {0, 0, 0}, 30); }).exit_code(), 2);
  EXPECT_EQ(thrown_error([] { Camera::perspective({1, 0, 0}, {0, 0, 0}, 180); }).exit_code(), 2);
  EXPECT_EQ(thrown_error([] { bounding_box({}); }).exit_code(), 2);
  const std::vector<float> broken{0, 0, std::numeric_limits<float>::infinity()};
  EXPECT_EQ(thrown_error([&] { bounding_box(broken); }).exit_code(), 2);
}

}  // namespace
}  // namespace hysteron::render
