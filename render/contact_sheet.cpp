#include "render/contact_sheet.h"

#include <algorithm>
#include <cmath>

#include "render/caption.h"
#include "sim/base/error.h"

namespace hysteron::render {
namespace {

constexpr Rgb8 kSheetPaper{255, 255, 255};
constexpr int kLeastCellWidth = 32;

struct Page {
  int columns, rows, gap, letters;
  int cell_width, cell_height;  // of a picture
  int caption_height, title_height;

  int width() const { return gap + columns * (cell_width + gap); }
  int height() const { return title_height + gap + rows * (cell_height + caption_height + gap); }
  int left(int entry) const { return gap + entry % columns * (cell_width + gap); }
  int top(int entry) const {
    return title_height + gap + entry / columns * (cell_height + caption_height + gap);
  }
};

Page page_of(const std::vector<SheetEntry>& entries, const SheetLayout& layout, int columns) {
  Page page{};
  const int count = static_cast<int>(entries.size());
  page.columns = columns;
  page.rows = (count + columns - 1) / columns;
  page.gap = std::max(4, layout.width / 90);
  page.letters = std::max(9, layout.width / 150);
  page.cell_width = (layout.width - page.gap * (columns + 1)) / columns;
  double tallest = 0;
  for (const SheetEntry& entry : entries)
    tallest = std::max(tallest, static_cast<double>(entry.image.height()) / entry.image.width());
  page.cell_height = std::max(1, static_cast<int>(std::lround(page.cell_width * tallest)));
  const bool captions =
      std::any_of(entries.begin(), entries.end(), [](const auto& e) { return !e.caption.empty(); });
  page.caption_height = captions ? 2 * page.letters : 0;
  page.title_height = layout.title.empty() ? 0 : 3 * page.letters;
  return page;
}

Page best_page(const std::vector<SheetEntry>& entries, const SheetLayout& layout) {
  if (layout.columns > 0) return page_of(entries, layout, layout.columns);
  Page best = page_of(entries, layout, 1);
  const auto misfit = [](const Page& page) {
    return std::abs(std::log(page.width() / (1.5 * page.height())));
  };
  for (int columns = 2; columns <= static_cast<int>(entries.size()); ++columns) {
    const Page page = page_of(entries, layout, columns);
    if (page.cell_width >= kLeastCellWidth && misfit(page) < misfit(best)) best = page;
  }
  return best;
}

// As large as the cell allows, never enlarged.
Image fitted(const Image& image, const Page& page) {
  const double scale = std::min({1.0, static_cast<double>(page.cell_width) / image.width(),
                                 static_cast<double>(page.cell_height) / image.height()});
  return shrink(image, std::max(1, static_cast<int>(std::lround(scale * image.width()))),
                std::max(1, static_cast<int>(std::lround(scale * image.height()))));
}

}  // namespace

Image contact_sheet(const std::vector<SheetEntry>& entries, const SheetLayout& layout) {
  if (entries.empty()) throw Error::request("contact sheet: there are no pictures");
  for (const SheetEntry& entry : entries)
    if (entry.image.empty())
      throw Error::request("contact sheet: the picture \"" + entry.caption + "\" is empty");
  const Page page = best_page(entries, layout);
  if (page.cell_width < kLeastCellWidth)
    throw Error::request("contact sheet: " + std::to_string(page.columns) + " columns in " +
                         std::to_string(layout.width) + " pixels leave " + std::to_string(page.cell_width) +
                         " for a picture; at least " + std::to_string(kLeastCellWidth) + " are needed");
  Image sheet(page.width(), page.height(), kSheetPaper);
  const auto letters = static_cast<float>(page.letters);
  if (!layout.title.empty())
    draw_text(sheet, layout.title, static_cast<float>(page.gap),
              static_cast<float>(page.gap) + 1.4f * letters, {.size = 1.4f * letters});
  for (int i = 0; i < static_cast<int>(entries.size()); ++i) {
    const Image cell = fitted(entries[i].image, page);
    paste(sheet, cell, page.left(i) + (page.cell_width - cell.width()) / 2,
          page.top(i) + (page.cell_height - cell.height()) / 2);
    draw_text(sheet, entries[i].caption, static_cast<float>(page.left(i)),
              static_cast<float>(page.top(i) + page.cell_height) + 1.6f * letters, {.size = letters});
  }
  return sheet;
}

std::vector<int> spread(int total, int count) {
  std::vector<int> indices;
  const int kept = std::min(total, count);
  for (int i = 0; i < kept; ++i)
    indices.push_back(kept == 1 ? total - 1 : static_cast<int>(std::lround(i * (total - 1.0) / (kept - 1))));
  return indices;
}

}  // namespace hysteron::render
