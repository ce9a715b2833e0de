#include "render/exposure.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "render/srgb.h"

namespace hysteron::render {
namespace {

using Bytes = std::vector<std::uint8_t>;

TEST(Exposure, AveragesPassesInLinearLight) {
  Exposure exposure(1, 1, 1);
  exposure.add(Bytes{0, 0, 100, 255});
  exposure.add(Bytes{255, 0, 100, 255});
  const Image image = exposure.image(false);
  EXPECT_EQ(image.channels(), 3);
  EXPECT_EQ(image.at(0, 0)[0], srgb8_of_linear(0.5f));
  EXPECT_EQ(image.at(0, 0)[1], 0);
  EXPECT_EQ(image.at(0, 0)[2], 100);
}

TEST(Exposure, OnePassKeepsEveryValueAndTurnsRowsOver) {
  Exposure exposure(16, 16, 1);
  Bytes drawn;
  for (int i = 0; i < 256; ++i) {
    const auto value = static_cast<std::uint8_t>(i);
    drawn.insert(drawn.end(), {value, value, value, 255});
  }
  exposure.add(drawn);
  const Image image = exposure.image(false);
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < 16; ++x) EXPECT_EQ(image.at(x, y)[1], 16 * (15 - y) + x);
}

TEST(Exposure, SupersamplingAveragesBlocks) {
  Exposure exposure(2, 1, 2);
  exposure.add(Bytes{0,   0,   0,   255, 255, 255, 255, 255, 9, 9, 9, 255, 9, 9, 9, 255,  //
                     255, 255, 255, 255, 0,   0,   0,   255, 9, 9, 9, 255, 9, 9, 9, 255});
  const Image image = exposure.image(false);
  EXPECT_EQ(image.at(0, 0)[0], srgb8_of_linear(0.5f));
  EXPECT_EQ(image.at(1, 0)[0], 9);
}

// Half covered by a colour: the colour itself at half the alpha, not the colour darkened.
TEST(Exposure, ColoursOfTransparentPicturesAreNotMultipliedByAlpha) {
  Exposure exposure(2, 1, 1);
  exposure.add(Bytes{200, 100, 50, 255, 0, 0, 0, 0});
  exposure.add(Bytes{0, 0, 0, 0, 0, 0, 0, 0});
  const Image image = exposure.image(true);
  ASSERT_EQ(image.channels(), 4);
  EXPECT_EQ(image.at(0, 0)[0], 200);
  EXPECT_EQ(image.at(0, 0)[2], 50);
  EXPECT_EQ(image.at(0, 0)[3], 128);
  EXPECT_EQ(image.at(1, 0)[3], 0);
}

// The standard pattern of four samples (D3D 11, Vulkan), in eighths of a pixel.
TEST(PassShift, TwoPassesOfFourSamplesShareNoRowAndNoColumn) {
  constexpr double kPattern[4][2] = {{3, 1}, {7, 3}, {1, 5}, {5, 7}};
  std::set<long> columns, rows;
  for (int pass = 0; pass < 2; ++pass) {
    const Shift shift = pass_shift(pass, 2, 4);
    for (const auto& sample : kPattern) {
      columns.insert(std::lround(16 * (sample[0] / 8 + shift.x)));
      rows.insert(std::lround(16 * (sample[1] / 8 + shift.y)));
    }
  }
  EXPECT_EQ(columns, (std::set<long>{1, 3, 5, 7, 9, 11, 13, 15}));
  EXPECT_EQ(rows, (std::set<long>{1, 3, 5, 7, 9, 11, 13, 15}));
}

TEST(PassShift, OnePassIsNotShifted) {
  EXPECT_EQ(pass_shift(0, 1, 8).x, 0);
  EXPECT_EQ(pass_shift(0, 1, 8).y, 0);
}

}  // namespace
}  // namespace hysteron::render
