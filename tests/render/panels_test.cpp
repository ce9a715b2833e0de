#include "render/panels.h"

#include "render/image.h"
#include "tests/render/test_scene.h"

namespace hysteron::render {
namespace {

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

using PanelsTest = test::GnuplotTest;

TEST_F(PanelsTest, StandInRowsOfTheGivenLengthWithTheirTitlesAndTexts) {
  write_panels(folder_.file("p"), panel_grid(4));
  EXPECT_EQ(folder_.names(), (std::vector<std::string>{"p.pdf", "p.png", "p.svg"}));
  const std::string svg = file_content(folder_.file("p.svg"));
  for (const char* text : {"panel_0", "panel_3", "B = 1", "lower right", "Loops", "red: a line", "x [m]"})
    EXPECT_TRUE(says(svg, text));
  const Image image = read_png(folder_.file("p.png"));
  const int ends[] = {0, kLeft + kColumn, kLeft + 2 * kColumn, image.width()};
  std::vector<int> red;  // pixels of the lines, by column of the grid
  for (int i = 0; i < 3; ++i)
    red.push_back(test::count_pixels(
        image, [](const std::uint8_t* p) { return p[0] > p[1] + 100; }, ends[i], 0, ends[i + 1]));
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
  EXPECT_TRUE(says(file_content(folder_.file("wide.svg")), "10"));
  EXPECT_FALSE(says(file_content(folder_.file("cut.svg")), "> 10<"));
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
