#include "render/palette.h"

#include <algorithm>
#include <array>
#include <string>

#include "sim/base/error.h"

namespace hysteron::render {
namespace {

// A colour of the picture and how many pixels have it.
struct Color {
  std::uint32_t code;  // red, green and blue in the low 24 bits
  std::int64_t pixels;
  std::int64_t channel(int c) const { return code >> (16 - 8 * c) & 255; }
};

std::uint32_t code_of(const std::uint8_t* rgb) { return rgb[0] << 16 | rgb[1] << 8 | rgb[2]; }

// In the order of their codes.
std::vector<Color> colors_of(const Image& image) {
  std::vector<std::uint32_t> codes;
  codes.reserve(image.pixels().size() / image.channels());
  for (std::size_t i = 0; i < image.pixels().size(); i += image.channels())
    codes.push_back(code_of(image.pixels().data() + i));
  std::sort(codes.begin(), codes.end());
  std::vector<Color> colors;
  for (const std::uint32_t code : codes) {
    if (colors.empty() || colors.back().code != code) colors.push_back({code, 0});
    ++colors.back().pixels;
  }
  return colors;
}

// A run of the list of colours, to be drawn as one.
struct Box {
  std::size_t begin, end;
  std::int64_t pixels = 0;
  std::array<std::int64_t, 3> sum{}, squares{};  // of each channel over the pixels

  std::int64_t mean(int c) const { return (2 * sum[c] + pixels) / (2 * pixels); }
  // Sum of squared distances to the mean, rounded up.  sum^2 / pixels in parts that 63 bits hold.
  std::int64_t error(int c) const {
    const std::int64_t whole = sum[c] / pixels, rest = sum[c] % pixels;
    return squares[c] - whole * (sum[c] + rest) - rest * rest / pixels;
  }
  std::int64_t error() const { return error(0) + error(1) + error(2); }
  int widest() const {
    int widest = 1;
    for (int c : {0, 2})
      if (error(c) > error(widest)) widest = c;
    return widest;
  }
};

Box box_of(const std::vector<Color>& colors, std::size_t begin, std::size_t end) {
  Box box{begin, end};
  for (std::size_t i = begin; i < end; ++i) {
    box.pixels += colors[i].pixels;
    for (int c = 0; c < 3; ++c) {
      const std::int64_t value = colors[i].channel(c);
      box.sum[c] += colors[i].pixels * value;
      box.squares[c] += colors[i].pixels * value * value;
    }
  }
  return box;
}

// Cuts until there are `count` boxes or every box is of one colour.  Reorders the colours within boxes.
std::vector<Box> boxes_of(std::vector<Color>& colors, std::size_t count) {
  std::vector<Box> boxes = {box_of(colors, 0, colors.size())};
  while (boxes.size() < count) {
    const auto worst = std::max_element(boxes.begin(), boxes.end(),
                                        [](const Box& a, const Box& b) { return a.error() < b.error(); });
    const Box box = *worst;
    const int c = box.widest();
    const auto middle =
        std::partition(colors.begin() + box.begin, colors.begin() + box.end,
                       [&](const Color& color) { return color.channel(c) * box.pixels <= box.sum[c]; });
    const std::size_t cut = middle - colors.begin();
    if (cut == box.begin || cut == box.end) break;
    *worst = box_of(colors, box.begin, cut);
    boxes.push_back(box_of(colors, cut, box.end));
  }
  return boxes;
}

}  // namespace

PaletteImage in_few_colors(const Image& image, int count) {
  if (image.empty()) throw Error::request("reducing colours: the picture is empty");
  if (count < 1 || count > 256)
    throw Error::request("reducing colours to " + std::to_string(count) + ": must be in [1, 256]");
  std::vector<Color> colors = colors_of(image);
  const std::vector<Box> boxes = boxes_of(colors, static_cast<std::size_t>(count));
  PaletteImage result{image.width(), image.height(), {}, {}};
  std::vector<std::uint8_t> index_of(1 << 24);
  for (const Box& box : boxes) {
    for (std::size_t i = box.begin; i < box.end; ++i)
      index_of[colors[i].code] = static_cast<std::uint8_t>(result.colors.size());
    result.colors.push_back({static_cast<std::uint8_t>(box.mean(0)), static_cast<std::uint8_t>(box.mean(1)),
                             static_cast<std::uint8_t>(box.mean(2))});
  }
  result.index.reserve(image.pixels().size() / image.channels());
  for (std::size_t i = 0; i < image.pixels().size(); i += image.channels())
    result.index.push_back(index_of[code_of(image.pixels().data() + i)]);
  return result;
}

}  // namespace hysteron::render
