#include "render/heat_map.h"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

#include "render/image.h"
#include "sim/base/process.h"
#include "tests/render/test_scene.h"

namespace hysteron::render {
namespace {

using test::Folder;
using test::thrown_error;

// Two maps of 3 x 2 cells: all of the first kind, and one of the second kind in the lower left corner.
HeatMaps two_maps() {
  HeatMaps page{"Outcomes",
                "numbers: steps",
                {"bending [N m]", {"1e-8", "1e-4", "1"}},
                {"step [s]", {"short", "long"}},
                {{"ended", "#00FF00"}, {"diverged", "#FF0000"}},
                {}};
  const std::vector<HeatMapCell> row(3, {0, "7"});
  page.maps = {{"left", {row, row}}, {"right", {row, row}}};
  page.maps[1].rows[0][0] = {1, "x_y"};
  page.columns = 2;
  return page;
}

int channel_pixels(const Image& image, int channel, int from_x, int to_x, int from_y, int to_y) {
  int count = 0;
  for (int y = from_y; y < to_y; ++y) {
    for (int x = from_x; x < to_x; ++x) {
      const std::uint8_t* pixel = image.at(x, y);
      bool pure = pixel[channel] > 200;
      for (int c = 0; c < 3; ++c) pure &= c == channel || pixel[c] < 60;
      count += pure;
    }
  }
  return count;
}

class HeatMapTest : public testing::Test {
 protected:
  void SetUp() override {
    if (run_process({"gnuplot", "--version"}, "").exit_code != 0)
      GTEST_SKIP() << "gnuplot is not installed (gnuplot-nox)";
  }
  Folder folder_;
};

TEST_F(HeatMapTest, EveryCellHasTheColourOfItsKindAtItsPlace) {
  write_heat_maps(folder_.file("m"), two_maps());
  EXPECT_EQ(folder_.names(), (std::vector<std::string>{"m.pdf", "m.png", "m.svg"}));
  const Image image = read_png(folder_.file("m.png"));
  constexpr int kLegendEnds = 110;                  // [pixels] from the top
  const int middle = 490, bottom = image.height();  // between the maps, in pixels
  const int green_left = channel_pixels(image, 1, 0, middle, kLegendEnds, bottom),
            red_left = channel_pixels(image, 0, 0, middle, kLegendEnds, bottom),
            red = channel_pixels(image, 0, 0, image.width(), kLegendEnds, bottom);
  ASSERT_GT(green_left, 1000);
  EXPECT_EQ(red_left, 0);
  constexpr double kTexts = 0.1;  // of a cell, hidden by its text
  EXPECT_NEAR(red, green_left / 6.0, kTexts * green_left / 6) << "one cell of six";
  const int half = kLegendEnds + 26 + 34;  // where the lower row of cells begins
  EXPECT_EQ(channel_pixels(image, 0, 0, image.width(), kLegendEnds, half), 0) << "rows stand from below";
}

TEST_F(HeatMapTest, TextsAxesAndLegendAreDrawnAsTheyAre) {
  write_heat_maps(folder_.file("m"), two_maps());
  std::ifstream file(folder_.file("m.svg"));
  const std::string svg{std::istreambuf_iterator<char>(file), {}};
  for (const char* text :
       {"Outcomes", "numbers: steps", "bending [N m]", "1e-4", "long", "right", "x_y", "diverged"})
    EXPECT_NE(svg.find(text), std::string::npos) << text;
}

TEST(HeatMap, WhatDoesNotFitItsAxesIsRefused) {
  const Folder folder;
  HeatMaps page = two_maps();
  page.maps[1].rows[1].pop_back();
  EXPECT_EQ(thrown_error([&] { write_heat_maps(folder.file("m"), page); }).exit_code(), 2);
  page.maps.clear();
  EXPECT_EQ(thrown_error([&] { write_heat_maps(folder.file("m"), page); }).exit_code(), 2);
  EXPECT_TRUE(folder.names().empty());
}

}  // namespace
}  // namespace hysteron::render
