#include "render/compare.h"

#include <cmath>

#include "render/color_map.h"
#include "tests/render/test_scene.h"

namespace hysteron::render {
namespace {

TEST(Compare, EqualPicturesDifferByNothing) {
  const Image image(4, 3, Rgb8{10, 20, 30});
  const Difference difference = compare(image, image);
  EXPECT_EQ(difference.mean_abs, 0);
  EXPECT_EQ(difference.rmse, 0);
  EXPECT_TRUE(std::isinf(difference.psnr_db));
  EXPECT_EQ(difference.pixels_over_8_percent, 0);
}

// 2 x 2 pixels, 12 channel values: one pixel differs by (6, 0, 0), another by (0, -12, 4).
TEST(Compare, MetricsMatchTheirDefinitions) {
  const Image a(2, 2, Rgb8{100, 100, 100});
  Image b = a;
  b.at(0, 0)[0] = 106;
  b.at(1, 1)[1] = 88;
  b.at(1, 1)[2] = 104;
  const Difference difference = compare(a, b);
  EXPECT_DOUBLE_EQ(difference.mean_abs, (6 + 12 + 4) / 12.0);
  EXPECT_DOUBLE_EQ(difference.rmse, std::sqrt((36 + 144 + 16) / 12.0));
  EXPECT_DOUBLE_EQ(difference.psnr_db, 20 * std::log10(255 / std::sqrt((36 + 144 + 16) / 12.0)));
  EXPECT_DOUBLE_EQ(difference.pixels_over_8_percent, 25.0);
  EXPECT_DOUBLE_EQ(compare(b, a).rmse, difference.rmse);
}

TEST(Compare, AlphaIsIgnored) {
  const Image rgb(1, 1, Rgb8{1, 2, 3});
  Image rgba(1, 1, 4);
  const std::uint8_t pixel[] = {1, 2, 3, 77};
  std::copy_n(pixel, 4, rgba.at(0, 0));
  EXPECT_EQ(compare(rgb, rgba).mean_abs, 0);
}

TEST(HeatMap, ShowsTheLargestChannelOnTheSequentialMap) {
  const Image a(2, 1, Rgb8{0, 0, 0});
  Image b = a;
  b.at(1, 0)[1] = 32;
  b.at(1, 0)[2] = 7;
  const Image heat = heat_map(a, b, 64);
  const Rgb8 none = map_color8(ColorMap::sequential, 0), half = map_color8(ColorMap::sequential, 0.5f);
  EXPECT_TRUE(std::equal(none.begin(), none.end(), heat.at(0, 0)));
  EXPECT_TRUE(std::equal(half.begin(), half.end(), heat.at(1, 0)));
}

}  // namespace
}  // namespace hysteron::render
