#include "render/palette.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sim/base/error.h"

namespace hysteron::render {
namespace {

// Red grows along x, green along y.
Image ramp(int width, int height) {
  Image image(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      image.at(x, y)[0] = static_cast<std::uint8_t>(255 * x / (width - 1));
      image.at(x, y)[1] = static_cast<std::uint8_t>(255 * y / (height - 1));
    }
  }
  return image;
}

Image drawn(const PaletteImage& palette) {
  Image image(palette.width, palette.height);
  for (std::size_t i = 0; i < palette.index.size(); ++i)
    std::copy_n(palette.colors[palette.index[i]].begin(), 3, image.pixels().begin() + 3 * i);
  return image;
}

double rms_difference(const Image& a, const Image& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.pixels().size(); ++i) sum += std::pow(a.pixels()[i] - b.pixels()[i], 2);
  return std::sqrt(sum / static_cast<double>(a.pixels().size()));
}

TEST(Palette, KeepsAPictureOfFewColorsAsItIs) {
  Image image(40, 30, Rgb8{255, 255, 255});
  paste(image, Image(7, 5, Rgb8{254, 255, 255}), 3, 3);  // differs by one: no box may swallow it
  paste(image, Image(1, 1, Rgb8{10, 20, 30}), 20, 20);
  const PaletteImage palette = in_few_colors(image, 3);
  EXPECT_EQ(palette.colors.size(), 3u);
  EXPECT_EQ(drawn(palette), image);
}

// A square of side 255 cut into n equal squares differs by 255 / sqrt(12 n) in red and green, by nothing in
// blue.
TEST(Palette, OfARampIsAsGoodAsEqualSquares) {
  const Image image = ramp(256, 256);
  for (const int n : {4, 16, 64, 256}) {
    const double equal_squares = 255 / std::sqrt(12.0 * n) * std::sqrt(2.0 / 3);
    EXPECT_NEAR(rms_difference(drawn(in_few_colors(image, n)), image), equal_squares, 0.05 * equal_squares)
        << n;
  }
}

TEST(Palette, SurvivesAsAPngFile) {
  const PaletteImage palette = in_few_colors(ramp(61, 47), 100);
  const std::vector<std::uint8_t> file = encode_png(palette);
  EXPECT_EQ(decode_png(file, "a ramp"), drawn(palette));
  EXPECT_EQ(encode_png(palette), file);
}

TEST(Palette, IgnoresTransparency) {
  Image image(4, 4, 4);
  for (std::size_t i = 0; i < image.pixels().size(); ++i) image.pixels()[i] = i % 4 == 3 ? 9 * (i / 4) : 77;
  EXPECT_EQ(in_few_colors(image, 256).colors, (std::vector<Rgb8>{{77, 77, 77}}));
}

TEST(Palette, RefusesNoPictureAndImpossibleCounts) {
  EXPECT_THROW(in_few_colors({}, 16), Error);
  EXPECT_THROW(in_few_colors(ramp(2, 2), 0), Error);
  EXPECT_THROW(in_few_colors(ramp(2, 2), 257), Error);
  EXPECT_THROW(encode_png(PaletteImage{}), Error);
}

}  // namespace
}  // namespace hysteron::render
