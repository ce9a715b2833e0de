#include "render/contact_sheet.h"

#include <algorithm>
#include <cstddef>

#include "tests/render/test_scene.h"

namespace hysteron::render {
namespace {

Rgb8 cell_color(int i) { return {static_cast<std::uint8_t>(20 + 30 * i), 0, 0}; }

std::vector<SheetEntry> entries(int count, int width = 640, int height = 360) {
  std::vector<SheetEntry> list;
  for (int i = 0; i < count; ++i)
    list.push_back({Image(width, height, cell_color(i)), "t = " + std::to_string(i) + " s"});
  return list;
}

// Returns the distinct entry colours along the middle of each picture row, in reading order.
std::vector<int> reading_order(const Image& sheet) {
  std::vector<int> order;
  for (int y = 0; y < sheet.height(); ++y)
    for (int x = 0; x < sheet.width(); ++x) {
      const std::uint8_t* p = sheet.at(x, y);
      if (p[1] != 0 || p[2] != 0 || p[0] < 20 || (p[0] - 20) % 30 != 0) continue;
      const int entry = (p[0] - 20) / 30;
      if (std::find(order.begin(), order.end(), entry) == order.end()) order.push_back(entry);
    }
  return order;
}

TEST(ContactSheet, ShowsEveryPictureInReadingOrder) {
  const Image sheet = contact_sheet(entries(7), {.title = "a title", .width = 900, .beside = 3});
  EXPECT_EQ(reading_order(sheet), (std::vector<int>{0, 1, 2, 3, 4, 5, 6}));
  EXPECT_NEAR(sheet.width(), 900, 3) << "columns share what the gaps leave, rounded down";
}

TEST(ContactSheet, CellsKeepTheAspect) {
  const Image sheet = contact_sheet(entries(1, 600, 300), {.title = "", .width = 420, .beside = 1});
  int columns = 0, rows = 0;
  for (int x = 0; x < sheet.width(); ++x) columns += sheet.at(x, sheet.height() / 3)[1] == 0;
  for (int y = 0; y < sheet.height(); ++y) rows += sheet.at(sheet.width() / 2, y)[1] == 0;
  EXPECT_NEAR(columns, 2 * rows, 2);
  EXPECT_GT(columns, 350);
}

TEST(ContactSheet, ChoosesColumnsNearThreeToTwo) {
  for (const int count : {4, 9, 12, 20}) {
    const Image sheet = contact_sheet(entries(count, 400, 400), {.title = "", .width = 1200});
    const double aspect = static_cast<double>(sheet.width()) / sheet.height();
    EXPECT_GT(aspect, 0.9) << count;
    EXPECT_LT(aspect, 2.3) << count;
  }
}

constexpr std::size_t kFrame = 1280 * 720, kThumbnail = 640 * 360;  // [pixels]

// Pixels read while `body` runs.
template <class Body>
std::size_t read_by(const Body& body) {
  const std::size_t before = pixels_shrunk();
  body();
  return pixels_shrunk() - before;
}

// Runs keep a thumbnail of 640 pixels a frame, so that the page never reads a whole frame again.
std::vector<SheetEntry> thumbnails(int frames) {
  std::vector<SheetEntry> all;
  const Image frame(1280, 720, cell_color(1));
  for (int i = 0; i < frames; ++i)
    all.push_back({shrink(frame, 640, 360), "t = " + std::to_string(i) + " s"});
  return all;
}

// Rows that lie across the border of two rows of the cell are read twice.
TEST(ContactSheet, OfSixtyFourFramesReadsEachPixelAtMostTwice) {
  std::vector<SheetEntry> all;
  EXPECT_EQ(read_by([&] { all = thumbnails(64); }), 64 * kFrame);
  const std::size_t page = read_by([&] { contact_sheet(all, {"64 frames"}); });
  EXPECT_GE(page, 64 * kThumbnail);
  EXPECT_LE(page, 2 * 64 * kThumbnail);
}

// Where nothing moves there is one instant and the last; else as much way lies between any two.
TEST(SpreadByDisplacement, PassesOverWhatStandsStill) {
  EXPECT_EQ(spread_by_displacement({0, 1, 1, 0, 0, 0, 0, 1, 1}, 5), (std::vector<int>{0, 1, 2, 7, 8}));
  EXPECT_EQ(spread_by_displacement({0, 0, 0, 0}, 3), (std::vector<int>{0, 3}));
  EXPECT_EQ(spread_by_displacement({0}, 3), (std::vector<int>{0}));
  EXPECT_TRUE(spread_by_displacement({}, 3).empty());
}

TEST(Spread, KeepsFirstAndLast) {
  EXPECT_EQ(spread(10, 4), (std::vector<int>{0, 3, 6, 9}));
  EXPECT_EQ(spread(3, 12), (std::vector<int>{0, 1, 2}));
  EXPECT_EQ(spread(5, 1), (std::vector<int>{4}));
  EXPECT_TRUE(spread(0, 4).empty());
}

TEST(Distinct, LeavesOutWhatWasThereBeforeAndEndsWithTheLast) {
  const std::vector<int> shown = {1, 1, 2, 3, 2, 3};
  EXPECT_EQ(distinct(shown.size(), [&](std::size_t a, std::size_t b) { return shown[a] == shown[b]; }),
            (std::vector<std::size_t>{0, 2, 5}));
  EXPECT_EQ(distinct(3, [](std::size_t, std::size_t) { return true; }), (std::vector<std::size_t>{0}))
      << "where nothing moves";
  EXPECT_TRUE(distinct(0, [](std::size_t, std::size_t) { return true; }).empty());
}

// The page is grey, with a square of one pixel of what a front page shows, or of thirty a side.
TEST(LookAlike, IsWhatAFrontPageCannotTellApart) {
  const Image page(300, 300, Rgb8{200, 200, 200});
  Image dotted = page, marked = page;
  paste(dotted, Image(3, 3, Rgb8{120, 120, 120}), 150, 150);
  paste(marked, Image(90, 90, Rgb8{120, 120, 120}), 150, 150);
  EXPECT_TRUE(look_alike(page, dotted));
  EXPECT_FALSE(look_alike(page, marked));
}

}  // namespace
}  // namespace hysteron::render
