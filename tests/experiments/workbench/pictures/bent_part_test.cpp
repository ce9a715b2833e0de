// Where most bending of a cloth lies in one part, a contact sheet shows that part from nearer by.
#include "experiments/workbench/pictures/bent_part.h"

#include <gtest/gtest.h>

#include <cmath>

namespace hysteron::experiments {
namespace {

// Returns the part of a flat sheet around the origin, a grid of vertices that is seen from its front;
// `curvature` gives that of a vertex [1/m] by its place in the plane [m].
template <class Curvature>
std::optional<NearerView> part_of(const Curvature& curvature, SheetView* seen = nullptr) {
  constexpr int kCells = 40;
  constexpr float kWidth = 0.2f, kHeight = 0.4f;
  ArchivedInstant instant;
  Bending bending;
  for (int i = 0; i <= kCells; ++i)
    for (int j = 0; j <= kCells; ++j) {
      const float x = kWidth * (static_cast<float>(i) / kCells - 0.5f),
                  z = kHeight * (static_cast<float>(j) / kCells - 0.5f);
      instant.xyz.insert(instant.xyz.end(), {x, 0, z});
      bending.curvature.push_back(curvature(x, z));
      bending.area.push_back(kWidth * kHeight / (kCells * kCells));
    }
  Options front;
  front.camera_direction = {0, -1, 0};
  const SheetView view = sheet_view({instant}, front, {{-1, -1, -1}, {1, 1, 1}});  // some 0.7 mm a pixel
  if (seen) *seen = view;
  return bent_part(instant.xyz, bending, view);
}

// Returns the curvature of a sheet that is bent near a knee [1/m].
auto near_knee(float there, float elsewhere = 1) {
  return [=](float x, float z) { return std::hypot(x - 0.05f, z + 0.1f) < 0.03f ? there : elsewhere; };
}

TEST(BentPart, IsInTheMiddleOfAPictureTwoAndAHalfTimesAsLarge) {
  SheetView whole;
  const auto part = part_of(near_knee(500), &whole);
  ASSERT_TRUE(part);
  EXPECT_EQ(part->enlargement, 2.5f);
  EXPECT_LT((part->camera.target() - Eigen::Vector3f(0.05f, 0, -0.1f)).norm(), 0.005);
  EXPECT_NEAR(part->camera.metres_per_pixel(part->camera.target(), whole.height) * 2.5,
              whole.metres_per_pixel, 1e-4 * whole.metres_per_pixel);
}

TEST(BentPart, IsNoneOfClothThatIsBentEverywhere) {
  EXPECT_FALSE(part_of([](float, float) { return 500.f; }));
  EXPECT_FALSE(part_of(near_knee(500, 200)));
}

TEST(BentPart, IsNoneOfFlatCloth) {
  EXPECT_FALSE(part_of([](float, float) { return 0.f; }));
}

TEST(BentPart, IsNoneOfFoldsThatAreLargeInThePicture) {
  SheetView whole;
  part_of(near_knee(1), &whole);
  const auto pixels = static_cast<float>(whole.metres_per_pixel);
  // Half of the part, which is a sixth of the sheet and its margin, is bent.
  EXPECT_TRUE(part_of(near_knee(1 / (6 * pixels))));
  EXPECT_FALSE(part_of(near_knee(1 / (25 * pixels), 0)));
}

TEST(BentPart, IsFoundByTheCurvatureOfAShape) {
  // A quarter of a cylinder, bent around y, of radius 0.1 m and length 0.1 m: kappa = 10/m on 0.0157 m^2.
  constexpr int kAround = 40, kAlong = 20;
  std::vector<float> xyz;
  std::vector<int> triangles;
  for (int i = 0; i <= kAround; ++i)
    for (int j = 0; j <= kAlong; ++j) {
      const float angle = static_cast<float>(i) / kAround * 1.5707963f;
      xyz.insert(xyz.end(),
                 {0.1f * std::cos(angle), 0.1f * static_cast<float>(j) / kAlong, 0.1f * std::sin(angle)});
      if (i == kAround || j == kAlong) continue;
      const int a = i * (kAlong + 1) + j, b = a + kAlong + 1;
      triangles.insert(triangles.end(), {a, b, a + 1, a + 1, b, b + 1});
    }
  EXPECT_NEAR(bending_of(xyz, triangles).total(), 1.571, 0.1 * 1.571)
      << "faces at free edges carry no curvature across them";
}

}  // namespace
}  // namespace hysteron::experiments
