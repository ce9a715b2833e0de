// Cells of a contact sheet share a scale; a picture that would be small at that scale states its own.
#include "experiments/workbench/pictures/sheet_view.h"

#include <gtest/gtest.h>

#include <cmath>

namespace hysteron::experiments {
namespace {

// Returns an instant of a grid of points, `width` by `height`, in the plane that the default camera sees
// slantwise [m].
ArchivedInstant sheet(float width, float height) {
  ArchivedInstant instant;
  for (int i = 0; i <= 10; ++i)
    for (int j = 0; j <= 10; ++j)
      for (const float x :
           {width * (static_cast<float>(i) / 10 - 0.5f), 0.f, height * (static_cast<float>(j) / 10 - 0.5f)})
        instant.xyz.push_back(x);
  return instant;
}

Options front() {
  Options options;
  options.camera_direction = {0, -1, 0};
  return options;
}

const render::Box kBounds{{-1, -1, -1}, {1, 1, 1}};

TEST(SheetView, OfACellHasTheShapeOfItsContents) {
  const SheetView leg = sheet_view({sheet(0.2f, 0.4f)}, front(), kBounds);
  EXPECT_NEAR(leg.aspect, 0.5, 1e-3);
  EXPECT_NEAR(leg.width, 0.5 * leg.height, 1);
  EXPECT_NEAR(0.4 / leg.metres_per_pixel, 0.88 * leg.height, 1) << "a margin of 6 % on either side";
}

TEST(SheetView, OfASmallInstantIsNearerByTheFactorThatItStates) {
  const ArchivedInstant large = sheet(0.4f, 0.4f), small = sheet(0.15f, 0.12f), nearly = sheet(0.28f, 0.2f);
  const SheetView view = sheet_view({large, small, large}, front(), kBounds);
  const auto nearer = nearer_view(small.xyz, view, front());
  ASSERT_TRUE(nearer);
  EXPECT_NEAR(nearer->enlargement, 2.6, 1e-6) << "0.4/0.15 = 2.67, rounded down";
  EXPECT_TRUE(nearer->camera.frames(small.xyz, view.aspect));
  EXPECT_NEAR(nearer->camera.metres_per_pixel(Eigen::Vector3f(0, 0, 0), view.height) * nearer->enlargement,
              view.metres_per_pixel, 1e-4 * view.metres_per_pixel);
  EXPECT_FALSE(nearer_view(nearly.xyz, view, front())) << "1.4 times";
  EXPECT_FALSE(nearer_view(large.xyz, view, front()));
}

TEST(SheetView, IsThatOfTheSequenceIfTheOptionsSetIt) {
  Options options = front();
  options.camera_distance = 3;
  const ArchivedInstant large = sheet(0.4f, 0.4f), small = sheet(0.1f, 0.1f);
  const SheetView view = sheet_view({large, small}, options, kBounds);
  EXPECT_NEAR((view.camera.eye() - view.camera.target()).norm(), 3, 1e-5);
  EXPECT_FALSE(nearer_view(small.xyz, view, options));
}

}  // namespace
}  // namespace hysteron::experiments
