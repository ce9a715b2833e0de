#include "render/plot_page.h"

#include <gtest/gtest.h>

#include "render/image.h"
#include "sim/base/process.h"
#include "tests/render/test_scene.h"

namespace hysteron::render {
namespace {

using test::Folder;
using test::thrown_error;

PlotPage two_plots() {
  Plot rising{"rising", {"x [m]"}, {"force [N]"}}, falling{"falling", {"t [s]", false, 0, 400}, {"y [mm]"}};
  rising.series = {{"a_1", {0, 1}, {0, 1}, Series::Style::line, "#FF0000"}};
  rising.marks = {{"here", 0.5, 0.5}};
  falling.series = {{"b", {0, 400}, {7, 1}, Series::Style::rings, "#0000FF"}};
  return {"Page", "what it shows", {{rising, "top left"}, {falling, "bottom left"}}, 2, 200, 150};
}

class PlotPageTest : public testing::Test {
 protected:
  void SetUp() override {
    if (run_process({"gnuplot", "--version"}, "").exit_code != 0)
      GTEST_SKIP() << "gnuplot is not installed (gnuplot-nox)";
  }
  Folder folder_;
};

TEST_F(PlotPageTest, EveryPlotHasItsOwnAxesKeyAndMarksOnce) {
  write_plot_page(folder_.file("p"), two_plots());
  EXPECT_EQ(folder_.names(), (std::vector<std::string>{"p.pdf", "p.png", "p.svg"}));
  const std::string svg = test::file_content(folder_.file("p.svg"));
  for (const char* text :
       {"Page", "what it shows", "rising", "falling", "x [m]", "t [s]", "force [N]", "y [mm]", "here"}) {
    const std::size_t at = svg.find(text);
    EXPECT_NE(at, std::string::npos) << text;
    EXPECT_EQ(svg.find(text, at + 1), std::string::npos) << text << " again";
  }
  EXPECT_NE(svg.find("a_1"), std::string::npos);
}

// The first plot in the left half, the second in the right.
TEST_F(PlotPageTest, PlotsStandBesideEachOther) {
  write_plot_page(folder_.file("p"), two_plots());
  const Image image = read_png(folder_.file("p.png"));
  int red_left = 0, red_right = 0, blue_left = 0, blue_right = 0;
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x) {
      const auto pixel = image.at(x, y);
      const bool left = x < image.width() / 2;
      if (pixel[0] > 200 && pixel[1] < 60 && pixel[2] < 60) ++(left ? red_left : red_right);
      if (pixel[2] > 200 && pixel[1] < 60 && pixel[0] < 60) ++(left ? blue_left : blue_right);
    }
  EXPECT_GT(red_left, 50);
  EXPECT_EQ(red_right, 0);
  EXPECT_EQ(blue_left, 0);
  EXPECT_GT(blue_right, 10);
}

TEST_F(PlotPageTest, WithoutPlotsOrDataIsRefused) {
  EXPECT_NE(std::string(thrown_error([&] { write_plot_page(folder_.file("p"), {}); }).what())
                .find("nothing to draw"),
            std::string::npos);
  PlotPage page = two_plots();
  page.plots[1].plot.series[0].y.pop_back();
  EXPECT_NE(std::string(thrown_error([&] { write_plot_page(folder_.file("p"), page); }).what())
                .find("series \"b\""),
            std::string::npos);
}

}  // namespace
}  // namespace hysteron::render
