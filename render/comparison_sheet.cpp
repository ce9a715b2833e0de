#include "render/comparison_sheet.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "render/sheet_layout.h"
#include "sim/base/error.h"

namespace hysteron::render {
namespace {

constexpr Rgb8 kPaper{255, 255, 255}, kInk{38, 40, 44}, kGrey{96, 99, 104};
constexpr float kPlateEdge = 0.02f;  // edge around an inset's frame, over its side
constexpr int kMinCell = 32;         // least width of a cell [pixels]

// Shortens a text until it fits; its end gives way to an ellipsis.
std::string fitting(std::string text, float letters, float room) {
  while (text.size() > 4 && text_width(text, letters) > room) {
    std::size_t cut = text.ends_with("…") ? text.size() - std::string("…").size() - 1 : text.size() - 1;
    while (cut > 0 && (text[cut] & 0xC0) == 0x80) --cut;  // the cut is not inside a letter
    text = text.substr(0, cut) + "…";
  }
  return text_width(text, letters) > room ? "" : text;
}

Image enlarged(const Image& source, int width, int height) {
  Image result(width, height, source.channels());
  const auto place = [](int i, int target, int from, int& low, float& fraction) {
    const float at = std::clamp(
        (static_cast<float>(i) + 0.5f) * static_cast<float>(from) / static_cast<float>(target) - 0.5f, 0.f,
        static_cast<float>(from - 1));
    low = std::min(static_cast<int>(at), std::max(0, from - 2));
    fraction = at - static_cast<float>(low);
  };
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      int left = 0, top = 0;
      float across = 0, down = 0;
      place(x, width, source.width(), left, across);
      place(y, height, source.height(), top, down);
      const int right = std::min(left + 1, source.width() - 1), low = std::min(top + 1, source.height() - 1);
      for (int c = 0; c < source.channels(); ++c) {
        const float upper = (1 - across) * source.at(left, top)[c] + across * source.at(right, top)[c],
                    lower = (1 - across) * source.at(left, low)[c] + across * source.at(right, low)[c];
        result.at(x, y)[c] = static_cast<std::uint8_t>(std::lround((1 - down) * upper + down * lower));
      }
    }
  return result;
}

// Scales a picture as large as the place and its pixels allow; its aspect stays.
Image fitted(const Image& image, int width, int height) {
  const double scale = std::min({static_cast<double>(width) / image.width(),
                                 static_cast<double>(height) / image.height(), kMaxEnlarged});
  const int w = std::clamp(static_cast<int>(std::lround(scale * image.width())), 1, width),
            h = std::clamp(static_cast<int>(std::lround(scale * image.height())), 1, height);
  return w <= image.width() && h <= image.height() ? shrink(image, w, h) : enlarged(image, w, h);
}

// Returns the longest length, 1, 2 or 5 times a power of ten [m], whose bar has room.
double bar_metres(double metres_per_pixel, double room) {
  const double most = metres_per_pixel * room, decade = std::pow(10, std::floor(std::log10(most)));
  return (most >= 5 * decade ? 5 : most >= 2 * decade ? 2 : 1) * decade;
}

// Adds a white margin on the right [pixels].
Image with_margin(const Image& source, int margin) {
  Image result(source.width() + margin, source.height(), kPaper);
  paste(result, source, 0, 0);
  return result;
}

// Multiplies the part of `below` under `above`, whose upper left corner lies at x, y, by it, as ink on paper
// does.
void multiply(Image& below, const Image& above, int x, int y) {
  for (int j = 0; j < above.height(); ++j)
    for (int i = 0; i < above.width(); ++i)
      for (int c = 0; c < 3; ++c) {
        std::uint8_t& value = below.at(x + i, y + j)[c];
        value = static_cast<std::uint8_t>(value * above.at(i, j)[c] / 255);
      }
}

int inset_side(const Image& cell) {
  return std::max(1, static_cast<int>(kInsetFraction * std::min(cell.width(), 2 * cell.height())));
}

// The place of a square within a picture, in shares of its free room from the upper left corner.
struct Place {
  double x = 1, y = 1;
};

// A table of sums from a picture's upper left corner gives the darkness of any rectangle of it.  Shadows
// count little.
class Darkness {
  // A shadow is at most kShadow 8-bit steps below white; darker pixels count kShadows times as much.
  static constexpr int kShadow = 60, kShadows = 32;

 public:
  explicit Darkness(const Image& image) : width_(image.width()), side_(inset_side(image)) {
    sum_.assign(static_cast<std::size_t>(width_ + 1) * (image.height() + 1), 0);
    for (int y = 0; y < image.height(); ++y) {
      long row = 0;
      for (int x = 0; x < width_; ++x) {
        const int dark = 255 - image.at(x, y)[1];
        row += dark > kShadow ? kShadows * dark : dark;
        sum_[index(x + 1, y + 1)] = sum_[index(x + 1, y)] + row;
      }
    }
    height_ = image.height();
  }

  // Returns the mean darkness under an inset there, in 8-bit steps.
  double under(const Place& place) const {
    const int x = static_cast<int>(place.x * (width_ - side_)),
              y = static_cast<int>(place.y * (height_ - side_));
    const long sum = sum_[index(x + side_, y + side_)] - sum_[index(x, y + side_)] -
                     sum_[index(x + side_, y)] + sum_[index(x, y)];
    return static_cast<double>(sum) / kShadows / side_ / side_;
  }

 private:
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_ + 1) + static_cast<std::size_t>(x);
  }

  int width_, height_ = 0, side_;
  std::vector<long> sum_;
};

// Returns the lower right corner, unless an inset hides less elsewhere.
Place emptiest_place(const std::vector<Darkness>& pictures) {
  constexpr int kSteps = 8;
  constexpr double kFar = 3;  // cost of all the way from the lower right corner, in 8-bit steps
  Place best;
  double least = std::numeric_limits<double>::infinity();
  for (int j = kSteps; j >= 0; --j)
    for (int i = kSteps; i >= 0; --i) {
      const Place place{1.0 * i / kSteps, 1.0 * j / kSteps};
      double cost = kFar * std::hypot(1 - place.x, 1 - place.y);
      for (const Darkness& picture : pictures) cost += picture.under(place);
      if (cost < least) least = cost, best = place;
    }
  return best;
}

// Returns the row's pictures that have an inset.
std::vector<Darkness> pictures_with_insets(const ComparisonSheet& sheet, std::size_t r) {
  std::vector<Darkness> pictures;
  for (const ComparisonColumn& column : sheet.columns)
    if (const ComparisonCell& cell = column.cells[r]; !cell.image.empty() && !cell.loop.empty())
      pictures.emplace_back(cell.busy.empty() ? cell.image : cell.busy);
  return pictures;
}

class Drawing {
 public:
  Drawing(const ComparisonSheet& sheet, SheetPage page)
      : sheet_(sheet), page_(std::move(page)), image_(page_.width, page_.height(), kPaper) {}

  Image draw() {
    for (std::size_t r = 0; r < sheet_.rows.size(); ++r)
      places_.push_back(emptiest_place(pictures_with_insets(sheet_, r)));
    head();
    for (const SheetPlaces& block : page_.blocks) draw_block(block);
    foot();
    return std::move(image_);
  }

 private:
  void text(const std::string& words, float x, int top, const Rgb8& color, float room, float growth = 1) {
    const float letters = growth * page_.letters;
    draw_text(image_, fitting(words, letters, room), x, static_cast<float>(top) + 1.25f * letters,
              {color, letters});
  }

  void head() {
    y_ = page_.gap;
    const float x = static_cast<float>(page_.gap), room = static_cast<float>(page_.width - 2 * page_.gap);
    for (const std::string& line : broken(sheet_.title, kSheetTitle * page_.letters, room)) {
      text(line, x, y_, kInk, room, kSheetTitle);
      y_ += static_cast<int>(std::lround(kSheetTitle * kSheetLine * page_.letters));
    }
    for (const std::string& note : sheet_.notes)
      for (const std::string& line : broken(note, page_.letters, room)) {
        text(line, x, y_, kGrey, room);
        y_ += page_.line();
      }
    y_ += page_.gap;
  }

  void draw_block(const SheetPlaces& block) {
    if (page_.families) {
      for (std::size_t i = 0; i < block.size(); ++i)
        if (const std::string& family = sheet_.columns[block[i]].family; family != family_)
          text(family_ = family, static_cast<float>(page_.left(i)), y_, kGrey,
               static_cast<float>(page_.cell_width));
      y_ += page_.line();
    }
    for (std::size_t i = 0; i < block.size(); ++i) caption(sheet_.columns[block[i]], page_.left(i));
    y_ += page_.caption_lines() * page_.line() + page_.gap / 2;
    for (std::size_t r = 0; r < sheet_.rows.size(); ++r) {
      instant(sheet_.rows[r], r);
      for (std::size_t i = 0; i < block.size(); ++i)
        cell(sheet_.columns[block[i]].cells[r], page_.left(i), r);
      y_ += page_.row_height[r] + page_.gap;
    }
    y_ += page_.gap;
  }

  void caption(const ComparisonColumn& column, int left) {
    const float letters = page_.letters, mark = mark_width(column, letters), x = static_cast<float>(left),
                top = static_cast<float>(y_) + 0.3f * letters;
    if (column.color) draw_rectangle(image_, x, top, x + letters, top + letters, *column.color);
    const float room = static_cast<float>(page_.cell_width) - mark;
    int y = y_;
    for (const std::string& line : name_lines(column, letters, page_.cell_width)) {
      const std::size_t behind = page_.numbers_below ? 0 : page_.numbers;
      text(with_numbers(line, column, behind), x + mark, y, kInk, room);
      y += page_.line();
    }
    if (page_.numbers_below) text(with_numbers("", column, page_.numbers), x + mark, y, kGrey, room);
  }

  // Writes a row's time and phase into the margin, and its scale where rows differ in it.
  void instant(const ComparisonRow& row, std::size_t r) {
    const float x = static_cast<float>(page_.gap), room = static_cast<float>(page_.margin);
    if (page_.margin == 0) return;
    int y = y_;
    text(row.time, x, y, kInk, room);
    for (const std::string& line : broken(row.phase, page_.letters, phase_room(page_)))
      text(line, x, y += page_.line(), kGrey, room);
    if (row.metres_per_pixel > 0 && !has_one_scale(sheet_))
      scale(row.metres_per_pixel * shown_pixels(r), x, y + 2 * page_.line(), 0.8 * page_.margin, "");
  }

  // Returns how many pixels of a picture in row r one pixel of the page shows.
  double shown_pixels(std::size_t r) const {
    for (const ComparisonColumn& column : sheet_.columns)
      if (const Image& image = column.cells[r].image; !image.empty())
        return static_cast<double>(image.width()) /
               fitted(image, page_.cell_width, page_.row_height[r]).width();
    return 1;
  }

  void cell(const ComparisonCell& from, int left, std::size_t r) {
    if (from.image.empty()) return;
    const int height = page_.row_height[r] - page_.note_height[r];
    Image cell = fitted(from.image, page_.cell_width, height);
    if (!from.loop.empty())
      inset(cell, from.loop, sheet_.in_sequence ? emptiest_place({Darkness(cell)}) : places_[r]);
    const int x = left + (page_.cell_width - cell.width()) / 2;
    paste(image_, cell, x, y_ + (height - cell.height()) / 2);
    text(from.note, static_cast<float>(x), y_ + height, kGrey,
         static_cast<float>(left + page_.cell_width - x));
  }

  void inset(Image& cell, const LoopInset& loop, const Place& place) {
    const int side = inset_side(cell);
    Image plate(side, side, kPaper);
    draw_loop(plate, loop, Corner::bottom_right, 1 - 2 * kPlateEdge, page_.letters);
    // Its white is that of the page: a shadow goes on below it.
    multiply(cell, plate, static_cast<int>(std::lround(place.x * (cell.width() - side))),
             static_cast<int>(std::lround(place.y * (cell.height() - side))));
  }

  // Draws a scale bar with its length below; returns the right end of both.
  float scale(double metres_per_pixel, float x, int top, double room, const std::string& note) {
    const double metres = bar_metres(metres_per_pixel, room);
    const float length = static_cast<float>(metres / metres_per_pixel), letters = page_.letters,
                y = static_cast<float>(top) + 0.5f * letters, thick = std::max(2.f, letters / 6);
    draw_rectangle(image_, x, std::round(y), x + length, std::round(y + thick), kInk);
    const std::string label = length_text(metres) + (note.empty() ? "" : " " + note);
    draw_text(image_, label, x, y + thick + 1.5f * letters, {kInk, letters});
    return x + std::max(length, text_width(label, letters));
  }

  void foot() {
    if (page_.foot == 0) return;
    float x = static_cast<float>(page_.left(0));
    const ComparisonRow& first = sheet_.rows[0];
    if (first.metres_per_pixel > 0 && has_one_scale(sheet_))
      x = scale(first.metres_per_pixel * shown_pixels(0), x, y_, 0.6 * page_.cell_width, sheet_.scale_note) +
          2 * page_.letters;
    // Each bar is drawn on a picture of its own, whose size sets that of its letters.
    for (const ColorBar& bar : sheet_.bars) {
      const int wide = static_cast<int>(80 * page_.letters), high = static_cast<int>(45 * page_.letters);
      Image whole(wide, high, kPaper);
      draw_color_bar(whole, bar, Corner::bottom_left);
      Image part(wide / 2, page_.foot, kPaper);
      paste(part, whole, 0, page_.foot - high + margin(whole));
      paste(image_, part, static_cast<int>(x) - margin(whole), y_);
      x += static_cast<float>(wide) * 0.32f;
    }
    if (page_.names_loops) loop_key(x);
  }

  // Draws the insets' key: axes of their frame alone, each with a tick, its value and unit.
  void loop_key(float x) {
    const int side = static_cast<int>(kLoopKey * page_.letters);
    for (const ComparisonColumn& column : sheet_.columns)
      for (const ComparisonCell& cell : column.cells) {
        if (cell.loop.empty()) continue;
        LoopInset axes = cell.loop;
        if (axes.frame.empty()) axes.frame.include(axes.path);
        axes.path = {{NAN}, {NAN}};
        axes.reference = {};
        Image plate(side, side, kPaper);
        draw_loop(plate, axes, Corner::bottom_right, 1 - 2 * kPlateEdge, page_.letters);
        paste(image_, plate, static_cast<int>(x), y_);
        const float behind = x + static_cast<float>(side) + page_.letters,
                    room = static_cast<float>(page_.width) - behind;
        text("insets: moment M against curvature κ", behind, y_, kInk, room);
        text(sheet_.loop_note, behind, y_ + page_.line(), kGrey, room);
        return;
      }
  }

  const ComparisonSheet& sheet_;
  SheetPage page_;
  Image image_;
  std::vector<Place> places_;  // places of insets by row
  std::string family_;         // family that was named last
  int y_ = 0;
};

bool is_dark(const Image& image, int x, int y) {
  if (x < 0 || y < 0 || x >= image.width() || y >= image.height()) return false;
  return image.at(x, y)[0] < 128;
}

// A row's pictures get a margin on the right if an inset would hide something of them.
ComparisonSheet with_room_for_insets(ComparisonSheet sheet) {
  constexpr double kNothing = 1;  // mean darkness under which an inset hides nothing, in 8-bit steps
  constexpr double kMargin = kInsetFraction / (1 - kInsetFraction);  // over a picture's size
  for (std::size_t r = 0; r < sheet.rows.size(); ++r) {
    const std::vector<Darkness> pictures = pictures_with_insets(sheet, r);
    const auto is_clear = [](const std::vector<Darkness>& beside) {
      const Place place = emptiest_place(beside);
      return std::ranges::all_of(beside, [&](const Darkness& one) { return one.under(place) <= kNothing; });
    };
    if (pictures.empty() ||
        (sheet.in_sequence
             ? std::ranges::all_of(pictures, [&](const Darkness& one) { return is_clear({one}); })
             : is_clear(pictures)))
      continue;
    for (ComparisonColumn& column : sheet.columns)
      for (Image* image : {&column.cells[r].image, &column.cells[r].busy})
        if (!image->empty())
          *image = with_margin(
              *image, static_cast<int>(std::ceil(kMargin * std::min(image->width(), 2 * image->height()))));
  }
  return sheet;
}

void check(const ComparisonSheet& sheet) {
  if (sheet.columns.empty() || sheet.rows.empty())
    throw Error::invalid_input("comparison: there are no columns or no rows");
  for (const ComparisonColumn& column : sheet.columns)
    if (column.cells.size() != sheet.rows.size())
      throw Error::invalid_input("comparison: the column \"" + column.name + "\" has " +
                                 std::to_string(column.cells.size()) + " cells for " +
                                 std::to_string(sheet.rows.size()) + " rows");
}

// Returns true if most of the picture's border is nearly white.
bool has_white_border(const Image& image) {
  constexpr int kNearlyWhite = 244;
  const int w = image.width(), h = image.height();
  long white = 0;
  for (int x = 0; x < w; ++x)
    white += (image.at(x, 0)[1] >= kNearlyWhite) + (image.at(x, h - 1)[1] >= kNearlyWhite);
  for (int y = 0; y < h; ++y)
    white += (image.at(0, y)[1] >= kNearlyWhite) + (image.at(w - 1, y)[1] >= kNearlyWhite);
  return white >= w + h;
}

}  // namespace

float sheet_letters(int width) { return std::ceil(static_cast<float>(width) / 84); }

Image draw_comparison(const ComparisonSheet& given) {
  check(given);
  const ComparisonSheet sheet = with_room_for_insets(given);
  SheetPage page = best_page(sheet);
  if (page.cell_width < kMinCell)
    throw Error::invalid_input("comparison: columns in " + std::to_string(sheet.width) + " pixels leave " +
                               std::to_string(page.cell_width) + " for a picture; at least " +
                               std::to_string(kMinCell) + " are needed");
  return Drawing(sheet, std::move(page)).draw();
}

void fade_to_page(Image& image, const PictureBox& kept) {
  const int w = image.width(), h = image.height();
  if (!has_white_border(image)) return;
  const auto band = [](double room, int size) {
    constexpr double kWidest = 0.2;
    return static_cast<float>(std::max(1.0, std::clamp(room, 0.0, kWidest) * size));
  };
  const float left = band(kept[0], w), top = band(kept[1], h), right = band(1 - kept[2], w),
              bottom = band(1 - kept[3], h);
  for (int y = 0; y < h; ++y)
    for (int x = 0; x < w; ++x) {
      const float in = std::min({static_cast<float>(x) / left, static_cast<float>(w - 1 - x) / right,
                                 static_cast<float>(y) / top, static_cast<float>(h - 1 - y) / bottom});
      if (in >= 1) continue;
      const float fraction = in * in * (3 - 2 * in);
      for (int c = 0; c < 3; ++c)
        image.at(x, y)[c] = static_cast<std::uint8_t>(
            std::lround(255 - fraction * static_cast<float>(255 - image.at(x, y)[c])));
    }
}

void draw_outline(Image& target, const Image& silhouette, const Rgb8& color, int width, bool dotted) {
  if (target.width() != silhouette.width() || target.height() != silhouette.height())
    throw Error::invalid_input("outline: the silhouette has another size than the picture");
  for (int y = 0; y < silhouette.height(); ++y)
    for (int x = 0; x < silhouette.width(); ++x) {
      if (!is_dark(silhouette, x, y) || (dotted && (x + y) / (3 * width) % 2)) continue;
      if (is_dark(silhouette, x - 1, y) && is_dark(silhouette, x + 1, y) && is_dark(silhouette, x, y - 1) &&
          is_dark(silhouette, x, y + 1))
        continue;
      const float half = static_cast<float>(width) / 2, px = static_cast<float>(x) + 0.5f,
                  py = static_cast<float>(y) + 0.5f;
      draw_rectangle(target, px - half, py - half, px + half, py + half, color);
    }
}

}  // namespace hysteron::render
