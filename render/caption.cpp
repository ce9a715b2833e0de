#include "render/caption.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "sim/error.h"

namespace hysteron::render {
namespace {

constexpr Rgb8 kInk{38, 40, 44};
constexpr Rgb8 kPaper{240, 240, 240};
constexpr float kLineSpacing = 1.9f;   // of the letter height
constexpr float kTitleGrowth = 1.25f;  // first line of a caption

bool is_right(Corner corner) { return corner == Corner::top_right || corner == Corner::bottom_right; }
bool is_bottom(Corner corner) { return corner == Corner::bottom_left || corner == Corner::bottom_right; }

std::vector<std::string_view> lines_of(std::string_view text) {
  std::vector<std::string_view> lines;
  while (!text.empty()) {
    const size_t end = std::min(text.find('\n'), text.size());
    lines.push_back(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return lines;
}

std::string number_text(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", value == 0 ? 0.0 : value);
  return text;
}

// With the unit that leaves a number from 1 to below 1000.
std::string length_text(double metres) {
  if (metres < 0.99e-3) return number_text(metres * 1e6) + " µm";
  if (metres < 0.99e-2) return number_text(metres * 1e3) + " mm";
  if (metres < 0.99) return number_text(metres * 1e2) + " cm";
  return number_text(metres) + " m";
}

// Text with a pale rim, so that it can be read over dark cloth too.
void draw_label(Image& image, std::string_view text, float x, float y, float size) {
  const float rim = std::max(1.0f, size / 9);
  for (int i = 0; i < 8; ++i) {
    const float angle = 0.785398f * static_cast<float>(i);
    draw_text(image, text, x + rim * std::cos(angle), y + rim * std::sin(angle), {kPaper, size});
  }
  draw_text(image, text, x, y, {kInk, size});
}

// Top left corner of a block of this size in a corner of the picture.
struct Place {
  float x, y;
};
Place place_block(const Image& image, Corner corner, float width, float height) {
  const auto gap = static_cast<float>(margin(image));
  return {is_right(corner) ? static_cast<float>(image.width()) - gap - width : gap,
          is_bottom(corner) ? static_cast<float>(image.height()) - gap - height : gap};
}

void draw_ramp(Image& image, const ColorBar& bar, float left, float top, float width, float height) {
  draw_rectangle(image, left - 1, top - 1, left + width + 1, top + height + 1, kInk);
  const int columns = std::max(1, static_cast<int>(width));
  for (int i = 0; i < columns; ++i) {
    const float begin = left + width * static_cast<float>(i) / static_cast<float>(columns);
    const float t = (static_cast<float>(i) + 0.5f) / static_cast<float>(columns);
    draw_rectangle(image, begin, top, begin + width / static_cast<float>(columns), top + height,
                   map_color8(bar.map, t));
  }
}

}  // namespace

float text_size(const Image& image) { return std::max(9.0f, static_cast<float>(image.height()) / 45); }

int margin(const Image& image) { return std::max(6, image.height() / 30); }

void draw_caption(Image& image, std::string_view text, Corner corner) {
  const auto lines = lines_of(text);
  const float size = text_size(image), spacing = kLineSpacing * size;
  const float height = kTitleGrowth * size + spacing * (static_cast<float>(lines.size()) - 1);
  float baseline = place_block(image, corner, 0, height).y + kTitleGrowth * size;
  for (size_t i = 0; i < lines.size(); ++i, baseline += spacing) {
    const float letters = i == 0 ? kTitleGrowth * size : size;
    draw_label(image, lines[i], place_block(image, corner, text_width(lines[i], letters), 0).x, baseline,
               letters);
  }
}

double scale_bar_length(const Image& image, double metres_per_pixel) {
  if (!(metres_per_pixel > 0) || !std::isfinite(metres_per_pixel))
    throw Error::request("scale bar: " + std::to_string(metres_per_pixel) + " m per pixel must be > 0");
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
  const float size = text_size(image), thick = std::max(2.0f, size / 5);
  const std::string label = length_text(metres) + (note.empty() ? "" : " " + std::string(note));
  const Place at = place_block(image, corner, length, 1.8f * size + thick);
  const float label_width = text_width(label, size);
  const float label_x = is_right(corner) ? at.x + length - label_width : at.x;
  draw_label(image, label, label_x, at.y + size, size);
  const float left = std::round(at.x), top = std::round(at.y + 1.8f * size);
  draw_rectangle(image, left - 1, top - 1, left + length + 1, top + std::round(thick) + 1, kPaper);
  draw_rectangle(image, left, top, left + length, top + std::round(thick), kInk);
  return length;
}

void draw_color_bar(Image& image, const ColorBar& bar, Corner corner) {
  if (!(bar.low < bar.high))
    throw Error::request("colour bar: low = " + number_text(bar.low) +
                         " must be below high = " + number_text(bar.high));
  const float size = text_size(image), width = 0.24f * static_cast<float>(image.width()), ramp = 0.9f * size;
  // The last number is centred under the bar's end.
  const float overhang = 0.5f * text_width(number_text(bar.high), 0.85f * size);
  const Place at = place_block(image, corner, width + overhang, 4.6f * size + ramp);
  const std::string title = bar.label + (bar.unit.empty() ? "" : " [" + bar.unit + "]");
  draw_label(image, title, at.x, at.y + size, size);
  const float top = std::round(at.y + 1.9f * size);
  draw_ramp(image, bar, std::round(at.x), top, std::round(width), std::round(ramp));
  const int ticks = std::max(2, bar.ticks);
  for (int i = 0; i < ticks; ++i) {
    const float share = static_cast<float>(i) / static_cast<float>(ticks - 1);
    const float x = std::round(at.x) + share * std::round(width);
    draw_rectangle(image, x - 0.5f, top + ramp, x + 0.5f, top + ramp + 0.45f * size, kInk);
    const std::string number = number_text(bar.low + (bar.high - bar.low) * share);
    draw_label(image, number, x - 0.5f * text_width(number, 0.85f * size), top + ramp + 1.6f * size,
               0.85f * size);
  }
}

}  // namespace hysteron::render
