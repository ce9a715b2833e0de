#include "render/comparison_sheet.h"

#include <algorithm>
#include <set>

#include "tests/render/test_scene.h"

namespace hysteron::render {
namespace {

// Cells are of one colour each, by column and row, on a page that has none of these.
Rgb8 cell_color(std::size_t column, std::size_t row) {
  return {static_cast<std::uint8_t>(10 + 12 * column), 200, static_cast<std::uint8_t>(10 + 40 * row)};
}

ComparisonSheet sample_sheet(std::size_t columns, std::size_t rows, int width = 400, int height = 300) {
  ComparisonSheet sheet;
  sheet.title = "Crease";
  for (std::size_t r = 0; r < rows; ++r) sheet.rows.push_back({std::to_string(r) + ".00 s", "", 1e-4});
  for (std::size_t c = 0; c < columns; ++c) {
    sheet.columns.push_back({"law " + std::to_string(c), {"116°", "κ 31 /m"}, Rgb8{0, 90, 0}, "", {}});
    for (std::size_t r = 0; r < rows; ++r)
      sheet.columns[c].cells.push_back({Image(width, height, cell_color(c, r))});
  }
  return sheet;
}

struct Extent {
  int left = 1 << 20, top = 1 << 20, right = -1, bottom = -1;
  int width() const { return right - left + 1; }
  int height() const { return bottom - top + 1; }
};

Extent color_extent(const Image& page, const Rgb8& color) {
  Extent at;
  for (int y = 0; y < page.height(); ++y)
    for (int x = 0; x < page.width(); ++x)
      if (std::equal(color.begin(), color.end(), page.at(x, y)))
        at = {std::min(at.left, x), std::min(at.top, y), std::max(at.right, x), std::max(at.bottom, y)};
  return at;
}

TEST(ComparisonSheet, IsTwiceTheWidthOfAFrontPageWithLettersByItsWidth) {
  const Image page = draw_comparison(sample_sheet(3, 2));
  EXPECT_EQ(page.width(), 2 * 838);
  EXPECT_GE(sheet_letters(page.width()), page.width() / 84.0);
  for (std::size_t c = 0; c < 3; ++c)
    for (std::size_t r = 0; r < 2; ++r) {
      const Extent cell = color_extent(page, cell_color(c, r));
      EXPECT_GT(cell.width(), 400) << "three cells share the page but for times and gaps";
      EXPECT_NEAR(cell.width(), cell.height() * 4 / 3.0, 2);
    }
}

TEST(ComparisonSheet, HasAtMostFiveColumnsBesideEachOther) {
  for (const std::size_t count : {1u, 2u, 5u, 6u, 9u, 15u}) {
    const Image page = draw_comparison(sample_sheet(count, 1));
    std::set<int> lefts;
    for (std::size_t c = 0; c < count; ++c) lefts.insert(color_extent(page, cell_color(c, 0)).left);
    EXPECT_LE(lefts.size(), static_cast<std::size_t>(kMaxBeside)) << count;
    const double aspect = 1.0 * page.width() / page.height();
    EXPECT_GE(aspect, 0.5) << count;
    EXPECT_LE(aspect, 3) << count;
  }
}

// A family begins a block where it does not fit behind another, whatever the order of its columns.
TEST(ComparisonSheet, KeepsFamiliesTogether) {
  ComparisonSheet sheet = sample_sheet(8, 1);
  for (std::size_t c = 0; c < 8; ++c) sheet.columns[c].family = c % 2 ? "plastic" : "elastic";
  const Image page = draw_comparison(sheet);
  std::set<int> elastic, plastic;
  for (std::size_t c = 0; c < 8; ++c)
    (c % 2 ? plastic : elastic).insert(color_extent(page, cell_color(c, 0)).top);
  for (int top : elastic) EXPECT_EQ(plastic.count(top), 0u);
}

// A name, however long, stays in its column.
TEST(ComparisonSheet, KeepsLongTextsInTheirColumns) {
  ComparisonSheet sheet = sample_sheet(2, 1);
  sheet.columns[0].name = std::string(300, 'W');
  sheet.columns[1].name.clear();
  sheet.columns[1].numbers.clear();
  sheet.columns[1].color.reset();
  const Image page = draw_comparison(sheet);
  const Extent right = color_extent(page, cell_color(1, 0));
  for (int y = 0; y < right.top; ++y)
    for (int x = right.left; x < page.width(); ++x) EXPECT_GT(page.at(x, y)[0], 200);
}

TEST(ComparisonSheet, SetsNumbersBelowNamesWhereNoneFindsRoomBehind) {
  ComparisonSheet sheet = sample_sheet(5, 2);
  for (ComparisonColumn& column : sheet.columns) column.name = "viscoelastic law";
  const Extent first = color_extent(draw_comparison(sheet), cell_color(0, 0));
  for (std::size_t c = 1; c < 5; ++c)
    EXPECT_EQ(color_extent(draw_comparison(sheet), cell_color(c, 0)).top, first.top) << "all in one block";
  for (ComparisonColumn& column : sheet.columns) column.numbers.clear();
  const double line = 1.65 * sheet_letters(sheet.width);
  EXPECT_NEAR(first.top - color_extent(draw_comparison(sheet), cell_color(0, 0)).top, line, 1);
}

TEST(ComparisonSheet, BreaksALongNameBeforeTheKeysThatItCarries) {
  ComparisonSheet sheet = sample_sheet(5, 2);
  for (ComparisonColumn& column : sheet.columns) column.numbers.clear();
  const Extent first = color_extent(draw_comparison(sheet), cell_color(0, 0));
  sheet.columns[1].name = "linear+fabric.damping=0.006378";
  const Image page = draw_comparison(sheet);
  const double line = 1.65 * sheet_letters(sheet.width);
  EXPECT_NEAR(color_extent(page, cell_color(0, 0)).top - first.top, 2 * line, 1) << "law, key, value";
  EXPECT_EQ(color_extent(page, cell_color(4, 0)).top, color_extent(page, cell_color(0, 0)).top)
      << "all in one block";
}

// Words in the margin make their row as high as they are, however low its pictures.
TEST(ComparisonSheet, KeepsWordsOfARowAboveTheNext) {
  ComparisonSheet sheet = sample_sheet(4, 2, 400, 20);
  sheet.beside = 4;
  const Extent low = color_extent(draw_comparison(sheet), cell_color(0, 0));
  for (ComparisonRow& row : sheet.rows) row.phase = "cycle 100, returned";
  const Image page = draw_comparison(sheet);
  const double line = 1.65 * sheet_letters(sheet.width);
  EXPECT_GE(color_extent(page, cell_color(0, 1)).top - color_extent(page, cell_color(0, 0)).top, 4 * line - 2)
      << "the time, cycle, 100, and returned; pictures are " << low.height() << " high";
}

// The same scale in all rows is said once, at the foot; rows that differ have a bar each.
// A film's pictures have one row each, and words of different lengths beside it.
TEST(ComparisonSheet, IsLaidOutAlikeForAllRowsOfAFilm) {
  const std::vector<ComparisonRow> rows = {{"0.00 s", "", 1e-4},
                                           {"11.50 s", "straightens slowly again", 1e-4}};
  std::vector<Extent> cells;
  for (const ComparisonRow& row : rows) {
    ComparisonSheet sheet = sample_sheet(2, 1, 400, 20);
    sheet.rows = {row};
    const int alone = draw_comparison(sheet).height();
    sheet.further_rows = rows;
    const Image page = draw_comparison(sheet);
    if (row.phase.empty()) EXPECT_GT(page.height(), alone) << "three words stand below each other";
    cells.push_back(color_extent(page, cell_color(1, 0)));
  }
  EXPECT_EQ(cells[0].left, cells[1].left);
  EXPECT_EQ(cells[0].right, cells[1].right);
  EXPECT_EQ(cells[0].top, cells[1].top);
}

TEST(ComparisonSheet, SaysAScaleOnce) {
  ComparisonSheet sheet = sample_sheet(2, 2);
  const int once = draw_comparison(sheet).height();
  sheet.rows[1].metres_per_pixel = 2e-4;
  EXPECT_LT(draw_comparison(sheet).height(), once);
}

TEST(LoopInset, EndsInADotOfItsColorWithinItsSquare) {
  Image picture(400, 300, Rgb8{255, 255, 255});
  LoopInset loop{.path = {{0, 50, 100}, {0, 2e-4, 3e-4}}, .color = {0, 0, 220}};
  draw_loop(picture, loop, Corner::top_right, 0.28f, 10);
  const auto is_blue = [](const std::uint8_t* pixel) { return pixel[2] > pixel[0] + 100; };
  const int blue = test::count_pixels(picture, is_blue);
  EXPECT_GT(blue, 40);
  EXPECT_EQ(test::count_pixels(picture, is_blue, 400 - 122, 0, 400, 123), blue) << "28 % of the width";
}

// In a cell whose right half is cloth the inset is drawn in the left one, though it belongs to the right.
TEST(ComparisonSheet, PutsInsetsWhereTheyHideNothing) {
  ComparisonSheet sheet = sample_sheet(1, 1);
  Image& picture = sheet.columns[0].cells[0].image = Image(400, 300, Rgb8{255, 255, 255});
  draw_rectangle(picture, 200, 0, 400, 300, {90, 91, 92});
  sheet.columns[0].cells[0].loop = {.path = {{0, 50, 100}, {0, 2e-4, 3e-4}}, .color = {0, 0, 220}};
  const Image page = draw_comparison(sheet);
  const Extent cloth = color_extent(page, {90, 91, 92}), loop = color_extent(page, {0, 0, 220});
  EXPECT_GT(loop.right, 0);
  EXPECT_LT(loop.right, cloth.left);
  // Where all of the picture is cloth the inset stands beside it.
  draw_rectangle(picture, 0, 0, 400, 300, {90, 91, 92});
  const Image full = draw_comparison(sheet);
  EXPECT_GT(color_extent(full, {0, 0, 220}).left, color_extent(full, {90, 91, 92}).right);
}

// A shadow goes on below an inset, whose white would cut it off.
TEST(ComparisonSheet, DrawsInsetsOverShadows) {
  ComparisonSheet sheet = sample_sheet(1, 1);
  sheet.columns[0].cells[0].image = Image(400, 300, Rgb8{230, 231, 232});
  sheet.columns[0].cells[0].loop = {.path = {{0, 50, 100}, {0, 2e-4, 3e-4}}, .color = {0, 0, 220}};
  const Image page = draw_comparison(sheet);
  const Extent cell = color_extent(page, {230, 231, 232});
  int lighter = 0, loop = 0;
  for (int y = cell.top; y <= cell.bottom; ++y)
    for (int x = cell.left; x <= cell.right; ++x) {
      lighter += page.at(x, y)[1] > 231;
      loop += page.at(x, y)[2] > page.at(x, y)[0] + 100;
    }
  EXPECT_GT(loop, 40);
  EXPECT_EQ(lighter, 0);
}

// Insets of narrow cells have no letters: once at the foot their axes have ticks with values and units.
TEST(ComparisonSheet, SaysOnceWhatSmallInsetsAre) {
  ComparisonSheet sheet = sample_sheet(5, 2);
  const int without = draw_comparison(sheet).height();
  for (ComparisonColumn& column : sheet.columns)
    for (ComparisonCell& cell : column.cells) {
      cell.image = Image(400, 300, Rgb8{255, 255, 255});
      cell.loop = {.path = {{0, 50, 100}, {0, 2e-4, 3e-4}}, .color = {0, 0, 220}};
    }
  EXPECT_GT(draw_comparison(sheet).height(), without + 5 * sheet_letters(sheet.width));
}

// Words never lie on the cloth.
TEST(ComparisonSheet, SetsNotesBelowTheirPictures) {
  ComparisonSheet sheet = sample_sheet(2, 1);
  const Image before = draw_comparison(sheet);
  sheet.columns[0].cells[0].note = "stopped at 0.90 s";
  const Image after = draw_comparison(sheet);
  EXPECT_GT(after.height(), before.height());
  const Extent cell = color_extent(after, cell_color(0, 0)), was = color_extent(before, cell_color(0, 0));
  EXPECT_EQ(cell.width(), was.width());
  EXPECT_EQ(cell.height(), was.height());
  for (int y = cell.top; y <= cell.bottom; ++y)
    for (int x = cell.left; x <= cell.right; ++x) ASSERT_EQ(after.at(x, y)[1], 200) << "nothing lies on it";
}

// One law that bends ten times as far leaves the others' loops as large as they were.
TEST(LoopInset, ReachesAsFarAsMostOfThePathsAndCutsWhatGoesFarBeyond) {
  std::vector<LoopFrame> frames(3);
  for (std::size_t i = 0; i < 3; ++i) {
    const double far = i == 2 ? 1000 : 100;
    frames[i].include({{0, far}, {-1e-3 * far, 0}});
  }
  const LoopFrame frame = LoopFrame::of_most(frames);
  EXPECT_EQ(frame.high_curvature, 100);
  EXPECT_EQ(frame.low_moment, -0.1);
  EXPECT_EQ(frame.low_curvature, 0);
  const Rgb8 color{200, 30, 30};
  Image picture(200, 150, {128, 128, 128});
  draw_loop(picture, {{{0, 1000}, {0, 0}}, {}, color, frame}, Corner::bottom_right, 0.28f, 10);
  const Extent line = color_extent(picture, color);
  EXPECT_GT(line.width(), 20);
  EXPECT_LT(line.right, 200 - 4) << "within the inset, whose dot is outside";
  EXPECT_LT(line.height(), 5);
}

TEST(DrawLine, CoversItsLengthTimesItsWidth) {
  Image image(100, 100, Rgb8{255, 255, 255});
  draw_line(image, 20, 50, 80, 50, 6, {0, 0, 0});
  const auto is_dark = [](const std::uint8_t* pixel) { return pixel[0] < 128; };
  EXPECT_NEAR(test::count_pixels(image, is_dark), 60 * 6 + 3.14159 * 9, 12);
}

}  // namespace
}  // namespace hysteron::render
