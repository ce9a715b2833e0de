#include "render/heat_map.h"

#include "render/image.h"
#include "tests/render/test_scene.h"

namespace hysteron::render {
namespace {

// Returns two maps of 3 x 2 cells: all cells are of the first kind, but one of the second kind in the lower
// left corner.
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

using HeatMapTest = test::GnuplotTest;

TEST_F(HeatMapTest, HasEveryCellInTheColourOfItsKindAtItsPlaceAndTextsAsTheyAre) {
  write_heat_maps(folder_.file("m"), two_maps());
  EXPECT_EQ(folder_.names(), (std::vector<std::string>{"m.pdf", "m.png", "m.svg"}));
  const Image image = read_png(folder_.file("m.png"));
  constexpr int kLegendEnds = 110;  // [pixels] from the top
  constexpr int kMiddle = 490;      // between the maps, in pixels
  const auto is_green = [](const std::uint8_t* p) { return p[1] > 200 && p[0] < 60 && p[2] < 60; };
  const auto is_red = [](const std::uint8_t* p) { return p[0] > 200 && p[1] < 60 && p[2] < 60; };
  const int green_left = test::count_pixels(image, is_green, 0, kLegendEnds, kMiddle),
            red_left = test::count_pixels(image, is_red, 0, kLegendEnds, kMiddle),
            red = test::count_pixels(image, is_red, 0, kLegendEnds);
  ASSERT_GT(green_left, 1000);
  EXPECT_EQ(red_left, 0);
  constexpr double kTexts = 0.1;  // of a cell, hidden by its text
  EXPECT_NEAR(red, green_left / 6.0, kTexts * green_left / 6) << "one cell of six";
  const int half = kLegendEnds + 26 + 34;  // where the lower row of cells begins
  EXPECT_EQ(test::count_pixels(image, is_red, 0, kLegendEnds, image.width(), half), 0)
      << "rows stand from below";
  const std::string svg = file_content(folder_.file("m.svg"));
  for (const char* text :
       {"Outcomes", "numbers: steps", "bending [N m]", "1e-4", "long", "right", "x_y", "diverged"})
    EXPECT_TRUE(says(svg, text));
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
