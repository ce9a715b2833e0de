#include "render/comparison_sheet.h"

#include <algorithm>
#include <cmath>

#include "sim/base/error.h"

namespace hysteron::render {
namespace {

constexpr Rgb8 kPaper{255, 255, 255}, kInk{38, 40, 44}, kGrey{96, 99, 104};
constexpr double kLine = 1.6;     // from baseline to baseline, in letters
constexpr int kFootHeight = 120;  // [pixels] at a cell of 420: colour bars and the scale bar
constexpr int kFootLetters = 6;   // heights of the foot in the picture whose letters its bars have

struct Page {
  int columns, gap, cell_width, cell_height, foot;
  float letters;
  int line() const { return static_cast<int>(std::lround(kLine * letters)); }
  int left(std::size_t column) const { return gap + static_cast<int>(column) * (cell_width + gap); }
  int width() const { return left(static_cast<std::size_t>(columns)); }
};

double tallest(const std::vector<ComparisonRow>& rows) {
  double aspect = 0;
  for (const ComparisonRow& row : rows)
    for (const ComparisonCell& cell : row.cells)
      if (!cell.image.empty())
        aspect = std::max(aspect, static_cast<double>(cell.image.height()) / cell.image.width());
  return aspect;
}

Page page_of(const ComparisonSheet& sheet) {
  Page page{};
  std::size_t columns = sheet.columns.size();
  for (const ComparisonRow& row : sheet.more) columns = std::max(columns, row.cells.size());
  page.columns = static_cast<int>(columns);
  page.cell_width = sheet.cell_width;
  page.gap = std::max(6, sheet.cell_width / 28);
  page.letters = std::max(9.f, static_cast<float>(sheet.cell_width) / 30);
  const double aspect = std::max(tallest(sheet.rows), tallest(sheet.more));
  page.cell_height = std::max(1, static_cast<int>(std::lround(aspect * sheet.cell_width)));
  page.foot = sheet.bars.empty() && !(sheet.metres_per_pixel > 0) ? 0 : kFootHeight * sheet.cell_width / 420;
  return page;
}

bool has_captions(const ComparisonRow& row) {
  return std::any_of(row.cells.begin(), row.cells.end(),
                     [](const ComparisonCell& c) { return !c.caption.empty(); });
}

int row_height(const ComparisonRow& row, const Page& page) {
  return (row.label.empty() ? 0 : page.line()) + page.cell_height + page.gap +
         (has_captions(row) ? page.line() : 0);
}

std::size_t most_numbers(const ComparisonSheet& sheet) {
  std::size_t most = 0;
  for (const ComparisonColumn& column : sheet.columns) most = std::max(most, column.numbers.size());
  return most;
}

int page_height(const ComparisonSheet& sheet, const Page& page) {
  int height = 2 * page.gap + page.line();
  if (!sheet.title.empty()) height += 2 * page.line();
  height += static_cast<int>(sheet.notes.size()) * page.line() + page.gap;
  for (const auto* rows : {&sheet.rows, &sheet.more})
    for (const ComparisonRow& row : *rows) height += row_height(row, page);
  height += static_cast<int>(most_numbers(sheet)) * page.line() + page.gap;
  return height + (page.foot > 0 ? page.foot + page.gap : 0);
}

// Text that fits: letters shrink to two thirds, then the end gives way to an ellipsis.
void draw_fitted(Image& image, std::string text, float x, float y, float room, TextStyle style) {
  const float wanted = text_width(text, style.size);
  if (wanted > room) style.size = std::max(style.size / 1.5f, style.size * room / wanted);
  while (text.size() > 4 && text_width(text, style.size) > room) {
    std::size_t cut = text.ends_with("…") ? text.size() - std::string("…").size() - 1 : text.size() - 1;
    while (cut > 0 && (text[cut] & 0xC0) == 0x80) --cut;  // not inside a letter
    text = text.substr(0, cut) + "…";
  }
  draw_text(image, text, x, y, style);
}

Image fitted(const Image& image, const Page& page) {
  const double scale = std::min({1.0, static_cast<double>(page.cell_width) / image.width(),
                                 static_cast<double>(page.cell_height) / image.height()});
  return shrink(image, std::max(1, static_cast<int>(std::lround(scale * image.width()))),
                std::max(1, static_cast<int>(std::lround(scale * image.height()))));
}

class Drawing {
 public:
  Drawing(const ComparisonSheet& sheet)
      : sheet_(sheet), page_(page_of(sheet)), image_(page_.width(), page_height(sheet, page_), kPaper) {}

  Image draw() {
    head();
    for (const ComparisonRow& row : sheet_.rows) cells(row);
    numbers();
    for (const ComparisonRow& row : sheet_.more) cells(row);
    foot();
    return std::move(image_);
  }

 private:
  float room() const { return static_cast<float>(page_.width() - 2 * page_.gap); }

  void line(const std::string& text, float x, float room, const TextStyle& style) {
    draw_fitted(image_, text, x, static_cast<float>(y_) + 1.2f * page_.letters, room, style);
  }

  void head() {
    y_ = page_.gap;
    const float x = static_cast<float>(page_.gap);
    if (!sheet_.title.empty()) {
      line(sheet_.title, x, room(), {kInk, 1.45f * page_.letters});
      y_ += 2 * page_.line();
    }
    for (const std::string& note : sheet_.notes) {
      line(note, x, room(), {kGrey, page_.letters});
      y_ += page_.line();
    }
    y_ += page_.gap;
    for (std::size_t c = 0; c < sheet_.columns.size(); ++c) {
      const float left = static_cast<float>(page_.left(c)), top = static_cast<float>(y_);
      const float mark = page_.letters;
      draw_rectangle(image_, left, top + 0.2f * mark, left + mark, top + 1.2f * mark,
                     sheet_.columns[c].color);
      line(sheet_.columns[c].name, left + 1.6f * mark, static_cast<float>(page_.cell_width) - 1.6f * mark,
           {kInk, 1.15f * page_.letters});
    }
    y_ += page_.line() + page_.gap;
  }

  void cells(const ComparisonRow& row) {
    if (!row.label.empty()) {
      line(row.label, static_cast<float>(page_.gap), room(), {kGrey, page_.letters});
      y_ += page_.line();
    }
    for (std::size_t c = 0; c < row.cells.size(); ++c) {
      if (row.cells[c].image.empty()) continue;
      const Image cell = fitted(row.cells[c].image, page_);
      paste(image_, cell, page_.left(c) + (page_.cell_width - cell.width()) / 2, y_);
    }
    y_ += page_.cell_height;
    if (has_captions(row)) {
      for (std::size_t c = 0; c < row.cells.size(); ++c)
        line(row.cells[c].caption, static_cast<float>(page_.left(c)), static_cast<float>(page_.cell_width),
             {kGrey, page_.letters});
      y_ += page_.line();
    }
    y_ += page_.gap;
  }

  void numbers() {
    for (std::size_t n = 0; n < most_numbers(sheet_); ++n) {
      for (std::size_t c = 0; c < sheet_.columns.size(); ++c)
        if (n < sheet_.columns[c].numbers.size())
          line(sheet_.columns[c].numbers[n], static_cast<float>(page_.left(c)),
               static_cast<float>(page_.cell_width), {kInk, page_.letters});
      y_ += page_.line();
    }
    y_ += page_.gap;
  }

  // Bars are drawn on strips of their own, whose height sets the letters' size, and put side by side.
  void foot() {
    if (page_.foot == 0) return;
    const int height = page_.foot, width = std::min(page_.width() / 2, 2 * page_.cell_width);
    int x = page_.gap;
    const auto strip = [&](const auto& draw) {
      Image bar(width, kFootLetters * height, kPaper);
      draw(bar);
      Image part(width, height, kPaper);
      paste(part, bar, 0, height - bar.height());
      paste(image_, part, x, y_);
      x += width + page_.gap;
    };
    if (sheet_.metres_per_pixel > 0) {
      const Image& first = first_image();
      const double shrunk = static_cast<double>(first.width()) / fitted(first, page_).width();
      strip([&](Image& bar) {
        draw_scale_bar(bar, sheet_.metres_per_pixel * shrunk, Corner::bottom_left, sheet_.scale_note);
      });
    }
    for (const ColorBar& bar : sheet_.bars)
      strip([&](Image& image) { draw_color_bar(image, bar, Corner::bottom_left); });
  }

  const Image& first_image() const {
    for (const ComparisonRow& row : sheet_.rows)
      for (const ComparisonCell& cell : row.cells)
        if (!cell.image.empty()) return cell.image;
    return image_;
  }

  const ComparisonSheet& sheet_;
  Page page_;
  Image image_;
  int y_ = 0;
};

bool is_dark(const Image& image, int x, int y) {
  if (x < 0 || y < 0 || x >= image.width() || y >= image.height()) return false;
  return image.at(x, y)[0] < 128;
}

}  // namespace

Image draw_comparison(const ComparisonSheet& sheet) {
  if (sheet.columns.empty()) throw Error::request("comparison: there are no columns");
  for (const ComparisonRow& row : sheet.rows)
    if (row.cells.size() != sheet.columns.size())
      throw Error::request("comparison: the row \"" + row.label + "\" has " +
                           std::to_string(row.cells.size()) + " cells for " +
                           std::to_string(sheet.columns.size()) + " columns");
  return Drawing(sheet).draw();
}

void draw_outline(Image& target, const Image& silhouette, const Rgb8& color, int width) {
  if (target.width() != silhouette.width() || target.height() != silhouette.height())
    throw Error::request("outline: the silhouette has another size than the picture");
  for (int y = 0; y < silhouette.height(); ++y)
    for (int x = 0; x < silhouette.width(); ++x) {
      if (!is_dark(silhouette, x, y)) continue;
      if (is_dark(silhouette, x - 1, y) && is_dark(silhouette, x + 1, y) && is_dark(silhouette, x, y - 1) &&
          is_dark(silhouette, x, y + 1))
        continue;
      const float half = static_cast<float>(width) / 2, px = static_cast<float>(x) + 0.5f,
                  py = static_cast<float>(y) + 0.5f;
      draw_rectangle(target, px - half, py - half, px + half, py + half, color);
    }
}

}  // namespace hysteron::render
