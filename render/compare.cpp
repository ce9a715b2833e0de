#include "render/compare.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <string>

#include "render/color_map.h"
#include "sim/base/error.h"

namespace hysteron::render {
namespace {

std::string size_text(const Image& image) {
  return std::to_string(image.width()) + " x " + std::to_string(image.height());
}

int largest_step(const std::uint8_t* a, const std::uint8_t* b) {
  return std::max({std::abs(a[0] - b[0]), std::abs(a[1] - b[1]), std::abs(a[2] - b[2])});
}

}  // namespace

void require_same_size(const Image& a, const Image& b) {
  if (a.width() != b.width() || a.height() != b.height() || a.empty())
    throw Error::invalid_input("comparing pictures of " + size_text(a) + " and " + size_text(b) +
                               " pixels: sizes must be equal and not zero");
}

Difference compare(const Image& a, const Image& b) {
  require_same_size(a, b);
  constexpr int kVisible = 8;
  long long sum = 0, squares = 0, over = 0;
  for (int y = 0; y < a.height(); ++y)
    for (int x = 0; x < a.width(); ++x) {
      const std::uint8_t *p = a.at(x, y), *q = b.at(x, y);
      for (int c = 0; c < 3; ++c) {
        const long long step = p[c] - q[c];
        sum += std::llabs(step);
        squares += step * step;
      }
      over += largest_step(p, q) > kVisible;
    }
  const double pixels = static_cast<double>(a.width()) * a.height();
  Difference result;
  result.mean_abs = static_cast<double>(sum) / (3 * pixels);
  result.rmse = std::sqrt(static_cast<double>(squares) / (3 * pixels));
  result.psnr_db = squares ? 20 * std::log10(255 / result.rmse) : std::numeric_limits<double>::infinity();
  result.pixels_over_8_percent = 100 * static_cast<double>(over) / pixels;
  return result;
}

Image heat_map(const Image& a, const Image& b, int full_scale) {
  require_same_size(a, b);
  if (full_scale < 1)
    throw Error::invalid_input("heat map: full scale = " + std::to_string(full_scale) +
                               " steps must be >= 1");
  std::array<Rgb8, 256> colors;
  for (int i = 0; i < 256; ++i)
    colors[i] = map_color8(ColorMap::sequential, static_cast<float>(i) / static_cast<float>(full_scale));
  Image result(a.width(), a.height());
  for (int y = 0; y < a.height(); ++y)
    for (int x = 0; x < a.width(); ++x)
      std::copy_n(colors[largest_step(a.at(x, y), b.at(x, y))].data(), 3, result.at(x, y));
  return result;
}

}  // namespace hysteron::render
