#include "render/panels.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "render/image.h"
#include "sim/base/process.h"
#include "tests/render/test_scene.h"

namespace hysteron::render {
namespace {

using test::Folder;
using test::thrown_error;

constexpr int kLeft = 90, kColumn = 172;  // [pixels] where the first panel begins, and every next one

Panels panel_grid(int count) {
  Panels grid{.title = "Loops", .subtitle = "red: a line", .x = {"x [m]"}, .y = {"y [m]"}, .panels = {}};
  grid.columns = 3;
  grid.panel_width = 150;
  grid.panel_height = 100;
  for (int i = 0; i < count; ++i) {
    Series line{.label = "", .x = {-1, 1}, .y = {-1, 1}, .color = "#FF0000"};
    grid.panels.push_back({"panel_" + std::to_string(i), {line}, {"B = 1"}, {"lower right"}});
  }
  return grid;
}

class PanelsTest : public testing::Test {
 protected:
  void SetUp() override {
    if (run_process({"gnuplot", "--version"}, "").exit_code != 0)
      GTEST_SKIP() << "gnuplot is not installed (gnuplot-nox)";
  }
  Folder folder_;
};

TEST_F(PanelsTest, EveryPanelHasItsTitleAndItsTexts) {
  write_panels(folder_.file("p"), panel_grid(5));
  EXPECT_EQ(folder_.names(), (std::vector<std::string>{"p.pdf", "p.png", "p.svg"}));
  const std::string svg = test::file_content(folder_.file("p.svg"));
  for (const char* text : {"panel_0", "panel_4", "B = 1", "lower right", "Loops", "red: a line", "x [m]"})
    EXPECT_NE(svg.find(text), std::string::npos) << text;
}

TEST_F(PanelsTest, PanelsStandInRowsOfTheGivenLength) {
  write_panels(folder_.file("p"), panel_grid(4));
  const Image image = read_png(folder_.file("p.png"));
  std::vector<int> red(3);  // pixels of the lines, by column of the grid
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      const std::uint8_t* pixel = image.at(x, y);
      red[std::clamp((x - kLeft) / kColumn, 0, 2)] += pixel[0] > pixel[1] + 100;
    }
  }
  EXPECT_GT(red[2], 100);
  EXPECT_NEAR(red[1], red[2], 0.1 * red[2]) << "one panel each";
  EXPECT_NEAR(red[0], 2.0 * red[2], 0.2 * red[2]) << "two panels, one below the other";
}

TEST_F(PanelsTest, AxesAreCommonToAllPanels) {
  Panels wide = panel_grid(2), cut = panel_grid(2);
  wide.panels[1].series[0].y = {-10, 10};
  cut.panels[1].series[0].y = {-10, 10};
  cut.y.low = -1, cut.y.high = 1;
  write_panels(folder_.file("wide"), wide);
  write_panels(folder_.file("cut"), cut);
  EXPECT_NE(test::file_content(folder_.file("wide.svg")).find("10"), std::string::npos);
  EXPECT_EQ(test::file_content(folder_.file("cut.svg")).find("> 10<"), std::string::npos);
}

TEST(Panels, NothingToDrawIsRefused) {
  const Folder folder;
  EXPECT_EQ(thrown_error([&] { write_panels(folder.file("p"), panel_grid(0)); }).exit_code(), 2);
  Panels uneven = panel_grid(2);
  uneven.panels[1].series[0].x.pop_back();
  EXPECT_EQ(thrown_error([&] { write_panels(folder.file("p"), uneven); }).exit_code(), 2);
  EXPECT_TRUE(folder.names().empty());
}

}  // namespace
}  // namespace hysteron::render
