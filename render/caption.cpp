#include "render/caption.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "sim/base/comma_list.h"
#include "sim/base/error.h"
#include "sim/base/number_in.h"

namespace hysteron::render {
namespace {

constexpr Rgb8 kInk{38, 40, 44};
constexpr Rgb8 kPaper{240, 240, 240};
constexpr Rgb8 kWhite{255, 255, 255};
constexpr float kLineSpacing = 1.9f;   // distance of baselines, in letter heights
constexpr float kTitleGrowth = 1.25f;  // size of a caption's first line over the others'
constexpr float kDescent = 0.35f;      // depth of letters below the line, in letter heights
constexpr float kSmallest = 6;         // smallest letters that can be read [pixels]

// Writes three digits, and zero without a sign.
std::string tick_text(double value) { return number_text(value == 0 ? 0.0 : value, 3); }

// The rim is white on transparent pictures, which are meant for white pages.
const Rgb8& rim_color(const Image& image) { return image.channels() == 4 ? kWhite : kPaper; }

// Draws text with a pale rim, so that it can be read over dark cloth too.
void draw_label(Image& image, std::string_view text, float x, float y, float size) {
  const float rim = std::max(1.0f, size / 9);
  for (int i = 0; i < 8; ++i) {
    const float angle = 0.785398f * static_cast<float>(i);
    draw_text(image, text, x + rim * std::cos(angle), y + rim * std::sin(angle), {rim_color(image), size});
  }
  draw_text(image, text, x, y, {kInk, size});
}

// The top left corner of a block in a corner of the picture [pixels].
struct Place {
  float x, y;
};
Place place_block(const Image& image, Corner corner, float width, float height) {
  const auto gap = static_cast<float>(margin(image));
  return {is_right(corner) ? static_cast<float>(image.width()) - gap - width : gap,
          is_bottom(corner) ? static_cast<float>(image.height()) - gap - height : gap};
}

// Breaks a line between words; a word longer than `width` stays whole.
std::vector<std::string> broken(std::string_view line, float size, float width) {
  std::vector<std::string> lines(1);
  while (!line.empty()) {
    const size_t end = std::min(line.find(' '), line.size());
    const std::string word(line.substr(0, end));
    line.remove_prefix(std::min(end + 1, line.size()));
    const std::string longer = lines.back().empty() ? word : lines.back() + ' ' + word;
    if (lines.back().empty() || text_width(longer, size) <= width)
      lines.back() = longer;
    else
      lines.push_back(word);
  }
  return lines;
}

struct Line {
  std::string text;
  float letters, width;
};

std::vector<Line> set_lines(std::string_view text, float size, float width) {
  std::vector<Line> lines;
  bool title = true;
  for (const std::string& line : hysteron::split(std::string(text), '\n')) {
    const float letters = title ? kTitleGrowth * size : size;
    for (const std::string& part : broken(line, letters, width))
      lines.push_back({part, letters, text_width(part, letters)});
    title = false;
  }
  return lines;
}

float block_height(const std::vector<Line>& lines, float size) {
  return size * (kTitleGrowth + kLineSpacing * (static_cast<float>(lines.size()) - 1) + kDescent);
}

// Sets lines as large as fit into the given space, at most `size`, which becomes the size taken.
std::vector<Line> fitted_lines(std::string_view text, float width, float height, float& size) {
  const auto fits = [width](const Line& line) { return line.width <= width; };
  for (;; size *= 0.95f) {
    std::vector<Line> lines = set_lines(text, size, width);
    if (std::all_of(lines.begin(), lines.end(), fits) && block_height(lines, size) <= height) return lines;
    if (0.95f * size >= kSmallest) continue;
    std::erase_if(lines, [&](const Line& line) { return !fits(line); });
    while (!lines.empty() && block_height(lines, size) > height) lines.pop_back();
    return lines;
  }
}

// Returns half of the picture's width without its margins [pixels].
float half_width(const Image& image) {
  return 0.5f * static_cast<float>(image.width()) - 1.25f * static_cast<float>(margin(image));
}

// Returns a size at which the text is no wider than its half of the picture.
float fitting_size(const Image& image, std::string_view text, float size) {
  return std::min(size, size * half_width(image) / std::max(text_width(text, size), 1e-3f));
}

int widest_number(const ColorBar& bar, float letters) {
  return static_cast<int>(std::ceil(
      std::max({text_width(tick_text(bar.low), letters), text_width(tick_text(bar.high), letters)})));
}

// Returns how many ticks apart numbers stand to find room.
int number_stride(const ColorBar& bar, int ticks, int step, float letters) {
  for (int stride = 1; stride < ticks - 1; ++stride)
    if ((ticks - 1) % stride == 0 &&
        static_cast<float>(stride * step) > static_cast<float>(widest_number(bar, letters)) + 0.5f * letters)
      return stride;
  return ticks - 1;
}

void draw_ramp(Image& image, ColorMap map, const ColorBarPlace& at) {
  const auto f = [](int x) { return static_cast<float>(x); };
  draw_rectangle(image, f(at.left - 1), f(at.top - 1), f(at.left + at.width + 1), f(at.top + at.height + 1),
                 kInk);
  for (int i = 0; i < at.width; ++i)
    draw_rectangle(image, f(at.left + i), f(at.top), f(at.left + i + 1), f(at.top + at.height),
                   map_color8(map, f(i) / f(at.width - 1)));
}

}  // namespace

std::string length_text(double metres) {
  if (metres < 0.99e-3) return number_text(metres * 1e6, 3, "µm");
  if (metres < 0.99e-2) return number_text(metres * 1e3, 3, "mm");
  if (metres < 0.99) return number_text(metres * 1e2, 3, "cm");
  return number_text(metres, 3, "m");
}

float text_size(const Image& image) {
  return std::max(9.0f,
                  std::min(static_cast<float>(image.height()) / 45, static_cast<float>(image.width()) / 80));
}

int margin(const Image& image) { return std::max(6, image.height() / 30); }

void draw_caption(Image& image, std::string_view text, Corner corner) {
  float size = text_size(image);
  const auto gap = 2 * static_cast<float>(margin(image));
  const auto lines = fitted_lines(text, static_cast<float>(image.width()) - gap,
                                  static_cast<float>(image.height()) - gap, size);
  float baseline = place_block(image, corner, 0, block_height(lines, size)).y + kTitleGrowth * size;
  for (const Line& line : lines) {
    draw_label(image, line.text, place_block(image, corner, line.width, 0).x, baseline, line.letters);
    baseline += kLineSpacing * size;
  }
}

double scale_bar_length(const Image& image, double metres_per_pixel) {
  if (!(metres_per_pixel > 0) || !std::isfinite(metres_per_pixel))
    throw Error::invalid_input("scale bar: " + std::to_string(metres_per_pixel) + " m per pixel must be > 0");
  const double wanted = metres_per_pixel * image.width() / 6;
  const double decade = std::pow(10, std::floor(std::log10(wanted)));
  double best = decade;
  for (const double factor : {2.0, 5.0, 10.0})
    if (std::abs(std::log(factor * decade / wanted)) < std::abs(std::log(best / wanted)))
      best = factor * decade;
  return best;
}

double draw_scale_bar(Image& image, double metres_per_pixel, Corner corner, std::string_view note) {
  const double metres = scale_bar_length(image, metres_per_pixel);
  const auto length = static_cast<float>(metres / metres_per_pixel);
  const std::string label = length_text(metres) + (note.empty() ? "" : " " + std::string(note));
  const float size = fitting_size(image, label, text_size(image)), thick = std::max(2.0f, size / 5);
  const Place at = place_block(image, corner, length, 1.8f * size + thick);
  const float label_width = text_width(label, size);
  const float label_x = is_right(corner) ? at.x + length - label_width : at.x;
  draw_label(image, label, label_x, at.y + size, size);
  const float left = std::round(at.x), top = std::round(at.y + 1.8f * size);
  draw_rectangle(image, left - 1, top - 1, left + length + 1, top + std::round(thick) + 1, rim_color(image));
  draw_rectangle(image, left, top, left + length, top + std::round(thick), kInk);
  return length;
}

ColorBarPlace draw_color_bar(Image& image, const ColorBar& bar, Corner corner) {
  if (!(bar.low < bar.high))
    throw Error::invalid_input("colour bar: low = " + tick_text(bar.low) +
                               " must be below high = " + tick_text(bar.high));
  const std::string title = bar.label + (bar.unit.empty() ? "" : " [" + bar.unit + "]");
  const float size = fitting_size(image, title, text_size(image)), letters = 0.85f * size;
  // The first and the last number are centred under the bar's ends.
  const float overhang = 0.5f * static_cast<float>(widest_number(bar, letters));
  const int ticks = std::max(2, bar.ticks);
  const float room = std::min(0.24f * static_cast<float>(image.width()), half_width(image) - 2 * overhang);
  const int step = static_cast<int>(room) / (ticks - 1);  // whole pixels, so that ticks stand on columns
  ColorBarPlace at;
  at.width = step * (ticks - 1) + 1;
  at.height = std::max(3, static_cast<int>(0.9f * size));
  const auto width = static_cast<float>(at.width), ramp = static_cast<float>(at.height);
  const Place block =
      place_block(image, corner, std::max(width + overhang, text_width(title, size)), 4.6f * size + ramp);
  if (step < 1 || block.x < 0 || block.y < 0) return {};
  at.left = static_cast<int>(std::round(std::max(block.x, overhang + 2)));
  at.top = static_cast<int>(std::round(block.y + 1.9f * size));
  draw_label(image, title, block.x, block.y + size, size);
  draw_ramp(image, bar.map, at);
  const int stride = number_stride(bar, ticks, step, letters);
  for (int i = 0; i < ticks; ++i) {
    at.tick_columns.push_back(at.left + i * step);
    const auto x = static_cast<float>(at.tick_columns.back()), below = static_cast<float>(at.top + at.height);
    draw_rectangle(image, x, below, x + 1, below + 0.45f * size, kInk);
    if (i % stride != 0) continue;
    const std::string number = tick_text(bar.low + (bar.high - bar.low) * i / (ticks - 1));
    draw_label(image, number, x + 0.5f - 0.5f * text_width(number, letters), below + 1.6f * size, letters);
  }
  return at;
}

}  // namespace hysteron::render
