#include "render/caption.h"

#include <cmath>
#include <limits>
#include <string>

#include "tests/render/test_scene.h"

namespace hysteron::render {
namespace {

constexpr Rgb8 kWhite{255, 255, 255};

bool is_ink(const std::uint8_t* pixel) { return pixel[1] < 100; }

// Longest run of dark pixels in any row.
int longest_run(const Image& image) {
  int longest = 0;
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0, run = 0; x < image.width(); ++x) {
      run = is_ink(image.at(x, y)) ? run + 1 : 0;
      longest = std::max(longest, run);
    }
  return longest;
}

int ink_in(const Image& image, int left = 0, int top = 0, int right = 1 << 20, int bottom = 1 << 20) {
  return test::count_pixels(image, is_ink, left, top, right, bottom);
}

TEST(ScaleBar, IsAsLongAsItsLabelSays) {
  for (const double metres_per_pixel : {3.1e-4, 1e-3, 2.7e-6, 0.02}) {
    for (const Corner corner : {Corner::bottom_left, Corner::top_right}) {
      Image image(960, 540, kWhite);
      const double length = draw_scale_bar(image, metres_per_pixel, corner);
      EXPECT_NEAR(length * metres_per_pixel, scale_bar_length(image, metres_per_pixel),
                  1e-6 * length * metres_per_pixel);
      constexpr double kEnds = 1.0;  // pixels: the ends may fall between two
      EXPECT_NEAR(longest_run(image), length, kEnds);
    }
  }
}

TEST(ScaleBar, LengthIsRoundAndNearASixthOfTheWidth) {
  const Image image(1200, 700);
  EXPECT_DOUBLE_EQ(scale_bar_length(image, 1e-3), 0.2);
  EXPECT_DOUBLE_EQ(scale_bar_length(image, 2.5e-4), 0.05);
  EXPECT_DOUBLE_EQ(scale_bar_length(image, 5e-4), 0.1);
  for (const double bad : {0.0, -1.0, std::nan(""), std::numeric_limits<double>::infinity()})
    EXPECT_EQ(thrown_error([&] { scale_bar_length(image, bad); }).exit_code(), 2);
}

TEST(Text, GreekAndSuperscriptsAreLetters) {
  EXPECT_NE(text_width("µ", 20), text_width("\xEF\xBF\xBD", 20));
  Image image(100, 40, kWhite);
  draw_text(image, "m²", 10, 30, {.size = 20});
  EXPECT_GT(ink_in(image, 30, 0, 60, 30), 10);
}

TEST(Text, WhatLeavesThePictureIsCutOff) {
  Image image(20, 20, kWhite);
  draw_text(image, "far too long for this", -15, 15, {.size = 12});
  EXPECT_GT(ink_in(image), 0);
  draw_text(image, "\xE2\x82", 2, 15, {.size = 12});  // a broken sequence must not be read beyond its end
}

// Area that is black, grey counted by its darkness.
double darkness(const Image& image) {
  double sum = 0;
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x) sum += 255 - image.at(x, y)[1];
  return sum / 255;
}

TEST(Caption, StandsInItsCornerAndGrowsWithThePicture) {
  double area[2];
  for (int i = 0; i < 2; ++i) {
    Image image(1280 << i, 720 << i, kWhite);
    draw_caption(image, "cotton broad\nprandtl, t = 1.25 s", Corner::bottom_right);
    const int ink = ink_in(image, image.width() / 2, image.height() / 2);
    EXPECT_GT(ink, 0);
    EXPECT_EQ(ink_in(image), ink);
    EXPECT_EQ(ink_in(image, image.width() - margin(image) + 2), 0) << "the margin stays free";
    area[i] = darkness(image);
  }
  constexpr double kHinting = 0.1;  // letters fall otherwise between pixels
  EXPECT_NEAR(area[1], 4 * area[0], kHinting * area[1]);
}

TEST(Caption, ABrokenLineKeepsAllItsWords) {
  const std::string text =
      "cotton broad\nlaw prandtl with eight stops at half the step, after three cycles of folding by half a "
      "turn"
      " and a day of recovery in the dark";
  Image whole(3200, 720, kWhite), narrow(1280, 720, kWhite);
  ASSERT_EQ(text_size(whole), text_size(narrow));
  draw_caption(whole, text, Corner::top_left);
  draw_caption(narrow, text, Corner::top_left);
  const int below_second = margin(narrow) + static_cast<int>(3.5f * text_size(narrow));
  EXPECT_EQ(ink_in(whole, 0, below_second), 0);
  EXPECT_GT(ink_in(narrow, 0, below_second), 0) << "a third line";
  constexpr double kSubpixels = 0.03;  // letters fall otherwise between pixels
  const double ink = ink_in(whole);
  EXPECT_NEAR(ink_in(narrow), ink, kSubpixels * ink);
}

// The colours read back at the ticks are those of the ticks' values, to the bit.
TEST(ColorBar, ShowsTheTicksValuesAtTheTicks) {
  for (const ColorMap map : {ColorMap::diverging, ColorMap::sequential})
    for (const int ticks : {2, 3, 5, 9})
      for (const auto& [width, height] : {std::pair(1280, 720), std::pair(320, 180)}) {
        Image image(width, height, kWhite);
        const ColorBarPlace place =
            draw_color_bar(image, {map, -3, 5, "curvature", "1/m", ticks}, Corner::bottom_right);
        ASSERT_EQ(static_cast<int>(place.tick_columns.size()), ticks);
        for (int i = 0; i < ticks; ++i) {
          const int x = place.tick_columns[i];
          const std::uint8_t* shown = image.at(x, place.top + place.height / 2);
          const Rgb8 expected = map_color8(map, static_cast<float>(i) / static_cast<float>(ticks - 1));
          EXPECT_EQ((Rgb8{shown[0], shown[1], shown[2]}), expected) << "tick " << i << " of " << ticks;
          EXPECT_TRUE(is_ink(image.at(x, place.top + place.height + 2))) << "tick " << i << " of " << ticks;
        }
      }
}

TEST(Text, OnATransparentPictureItIsOpaque) {
  Image image(60, 40, 4);
  draw_text(image, "H", 10, 30, {.color = {200, 10, 10}, .size = 20});
  bool opaque = false;
  for (int y = 0; y < 40; ++y)
    for (int x = 0; x < 60; ++x) {
      const std::uint8_t* p = image.at(x, y);
      if (p[3] > 0) {
        EXPECT_NEAR(p[0], 200, 1) << "edges keep the colour and are transparent";
      }
      opaque = opaque || p[3] == 255;
    }
  EXPECT_TRUE(opaque);
}

TEST(ColorBar, RunsFromTheMapsLowToItsHighColour) {
  Image image(1000, 600, kWhite);
  draw_color_bar(image,
                 {.map = ColorMap::diverging, .low = -50, .high = 50, .label = "curvature", .unit = "1/m"},
                 Corner::top_left);
  const Rgb8 low = map_color8(ColorMap::diverging, 0), high = map_color8(ColorMap::diverging, 1);
  const auto has_near = [&](const Rgb8& color, int left, int right) {
    const auto is_near = [&](const std::uint8_t* p) {
      return std::abs(p[0] - color[0]) + std::abs(p[1] - color[1]) + std::abs(p[2] - color[2]) < 6;
    };
    return test::count_pixels(image, is_near, left, 0, right, 150) > 0;
  };
  EXPECT_TRUE(has_near(low, 0, 60));
  EXPECT_FALSE(has_near(low, 200, 400));
  EXPECT_TRUE(has_near(high, 200, 400));
  EXPECT_EQ(thrown_error([&] {
              draw_color_bar(image, {.low = 1, .high = 1, .label = "", .unit = ""}, Corner::top_left);
            }).exit_code(),
            2);
}

}  // namespace
}  // namespace hysteron::render
