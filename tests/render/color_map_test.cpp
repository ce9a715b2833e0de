#include "render/color_map.h"

#include <gtest/gtest.h>

#include "render/lab.h"

namespace hysteron::render {
namespace {

double lightness_of(const Rgb8& color) { return lightness(color.data()); }

// An 8-bit step changes L* by up to about half a unit in the dark.
constexpr double kByteRounding = 0.6;

TEST(ColorMap, SequentialLightnessRisesAllTheWay) {
  double before = lightness_of(map_color8(ColorMap::sequential, 0));
  const double first = before;
  for (int i = 1; i <= 64; ++i) {
    const double here = lightness_of(map_color8(ColorMap::sequential, static_cast<float>(i) / 64));
    EXPECT_GT(here, before - kByteRounding);
    if (i % 8 == 0) {
      EXPECT_GT(here, first + i * 0.8) << "equal steps must be seen as steps, at " << i << "/64";
    }
    before = here;
  }
  EXPECT_GT(before - first, 60);
}

TEST(ColorMap, DivergingLightnessFallsFromTheMiddleToBothEndsAlike) {
  for (int i = 1; i <= 32; ++i) {
    const float t = static_cast<float>(i) / 64, inner = static_cast<float>(i - 1) / 64;
    const double left = lightness_of(map_color8(ColorMap::diverging, 0.5f - t));
    const double right = lightness_of(map_color8(ColorMap::diverging, 0.5f + t));
    EXPECT_LT(left, lightness_of(map_color8(ColorMap::diverging, 0.5f - inner)) + kByteRounding);
    EXPECT_LT(right, lightness_of(map_color8(ColorMap::diverging, 0.5f + inner)) + kByteRounding);
    // Oklab's lightness and L* weigh blue and orange a little differently.
    EXPECT_NEAR(left, right, 8);
  }
  EXPECT_GT(lightness_of(map_color8(ColorMap::diverging, 0.5f)), 93);
}

TEST(ColorMap, ValuesBeyondTheEndsTakeTheEndsColour) {
  for (const ColorMap map : {ColorMap::sequential, ColorMap::diverging}) {
    EXPECT_EQ(map_color8(map, -3), map_color8(map, 0));
    EXPECT_EQ(map_color8(map, 7), map_color8(map, 1));
  }
}

}  // namespace
}  // namespace hysteron::render
