#include "render/plot_page.h"

#include "render/image.h"
#include "tests/render/test_scene.h"

namespace hysteron::render {
namespace {

PlotPage two_plots() {
  Plot rising{"rising", {"x [m]"}, {"force [N]"}}, falling{"falling", {"t [s]", false, 0, 400}, {"y [mm]"}};
  rising.series = {{"a_1", {0, 1}, {0, 1}, Series::Style::line, "#FF0000"}};
  rising.marks = {{"here", 0.5, 0.5}};
  falling.series = {{"b", {0, 400}, {7, 1}, Series::Style::rings, "#0000FF"}};
  return {"Page", "what it shows", {{rising, "top left"}, {falling, "bottom left"}}, 2, 200, 150};
}

using PlotPageTest = test::GnuplotTest;

// The first plot is in the left half, the second in the right.
TEST_F(PlotPageTest, HasItsPlotsBesideEachOtherWithTheirOwnAxesKeysAndMarks) {
  write_plot_page(folder_.file("p"), two_plots());
  EXPECT_EQ(folder_.names(), (std::vector<std::string>{"p.pdf", "p.png", "p.svg"}));
  const std::string svg = file_content(folder_.file("p.svg"));
  for (const char* text :
       {"Page", "what it shows", "rising", "falling", "x [m]", "t [s]", "force [N]", "y [mm]", "here"}) {
    const std::size_t at = svg.find(text);
    EXPECT_NE(at, std::string::npos) << text;
    EXPECT_EQ(svg.find(text, at + 1), std::string::npos) << text << " again";
  }
  EXPECT_TRUE(says(svg, "a_1"));
  const Image image = read_png(folder_.file("p.png"));
  const int middle = image.width() / 2;
  const auto is_red = [](const std::uint8_t* p) { return p[0] > 200 && p[1] < 60 && p[2] < 60; };
  const auto is_blue = [](const std::uint8_t* p) { return p[2] > 200 && p[1] < 60 && p[0] < 60; };
  EXPECT_GT(test::count_pixels(image, is_red, 0, 0, middle), 50);
  EXPECT_EQ(test::count_pixels(image, is_red, middle), 0);
  EXPECT_EQ(test::count_pixels(image, is_blue, 0, 0, middle), 0);
  EXPECT_GT(test::count_pixels(image, is_blue, middle), 10);
}

TEST_F(PlotPageTest, WithoutPlotsOrDataIsRefused) {
  EXPECT_TRUE(says(thrown_error([&] { write_plot_page(folder_.file("p"), {}); }).what(), "nothing to draw"));
  PlotPage page = two_plots();
  page.plots[1].plot.series[0].y.pop_back();
  EXPECT_TRUE(says(thrown_error([&] { write_plot_page(folder_.file("p"), page); }).what(), "series \"b\""));
}

}  // namespace
}  // namespace hysteron::render
