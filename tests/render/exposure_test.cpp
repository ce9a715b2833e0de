#include "render/exposure.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "render/srgb.h"

namespace hysteron::render {
namespace {

using Light = std::vector<float>;

float light(int step) { return linear_of_srgb8()[static_cast<std::size_t>(step)]; }

TEST(Exposure, AveragesPassesInLinearLight) {
  Exposure exposure(64, 64, 1);
  Light dark, bright;
  for (int i = 0; i < 64 * 64; ++i) {
    dark.insert(dark.end(), {0, 0, light(100), 1});
    bright.insert(bright.end(), {1, 0, light(100), 1});
  }
  exposure.add(dark);
  exposure.add(bright);
  const Image image = exposure.image(false);
  EXPECT_EQ(image.channels(), 3);
  double sum[3] = {0, 0, 0};
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 64; ++x)
      for (int c = 0; c < 3; ++c) sum[c] += image.at(x, y)[c];
  constexpr double kNoise = 0.05;  // of a mean over 4,096 pixels, each off by half a step
  EXPECT_NEAR(sum[0] / 4096, 255 * srgb_of_linear(0.5f), kNoise);
  EXPECT_EQ(sum[1], 0);
  EXPECT_NEAR(sum[2] / 4096, 100, kNoise);
}

TEST(Exposure, OnePassKeepsEveryValueToAStepAndTurnsRowsOver) {
  Exposure exposure(16, 16, 1);
  Light drawn;
  for (int i = 0; i < 256; ++i) drawn.insert(drawn.end(), {light(i), light(i), light(i), 1});
  exposure.add(drawn);
  const Image image = exposure.image(false);
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < 16; ++x) EXPECT_NEAR(image.at(x, y)[1], 16 * (15 - y) + x, 1);
  EXPECT_EQ(image.at(15, 0)[1], 255);
  EXPECT_EQ(image.at(0, 15)[1], 0);
}

// A ramp of a step in 100 pixels: rounded alone it would be a plateau of 100 pixels.
TEST(Exposure, GradientsHaveNoPlateaus) {
  constexpr int kWidth = 1000, kRows = 16;
  Exposure exposure(kWidth, kRows, 1);
  Light drawn;
  for (int y = 0; y < kRows; ++y)
    for (int x = 0; x < kWidth; ++x) {
      const float v = linear_of_srgb((100 + static_cast<float>(x) / 100) / 255);
      drawn.insert(drawn.end(), {v, v, v, 1});
    }
  exposure.add(drawn);
  const Image image = exposure.image(false);
  double plateaus = 0, runs = 0;
  for (int y = 0; y < kRows; ++y)
    for (int x = 1, length = 1; x < kWidth; ++x, ++length)
      if (image.at(x, y)[0] != image.at(x - 1, y)[0]) {
        ++runs;
        plateaus += length > 6;
        length = 0;
      }
  EXPECT_LE(plateaus / runs, 0.05);
}

TEST(Exposure, SupersamplingAveragesBlocks) {
  Exposure exposure(2, 1, 2);
  const float grey = light(9);
  exposure.add(Light{0, 0, 0, 1, 1, 1, 1, 1, grey, grey, grey, 1, grey, grey, grey, 1,  //
                     1, 1, 1, 1, 0, 0, 0, 1, grey, grey, grey, 1, grey, grey, grey, 1});
  const Image image = exposure.image(false);
  EXPECT_NEAR(image.at(0, 0)[0], srgb8_of_linear(0.5f), 1);
  EXPECT_NEAR(image.at(1, 0)[0], 9, 1);
}

// A pixel half covered by a colour has the colour itself at half the alpha, not the colour darkened.
TEST(Exposure, ColoursOfTransparentPicturesAreNotMultipliedByAlpha) {
  Exposure exposure(2, 1, 1);
  exposure.add(Light{light(200), light(100), light(50), 1, 0, 0, 0, 0});
  exposure.add(Light{0, 0, 0, 0, 0, 0, 0, 0});
  const Image image = exposure.image(true);
  ASSERT_EQ(image.channels(), 4);
  EXPECT_NEAR(image.at(0, 0)[0], 200, 1);
  EXPECT_NEAR(image.at(0, 0)[2], 50, 1);
  EXPECT_EQ(image.at(0, 0)[3], 128);
  EXPECT_EQ(image.at(1, 0)[3], 0);
}

// Each pass has the standard pattern of four samples (D3D 11, Vulkan), in eighths of a pixel.
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
