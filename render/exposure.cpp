#include "render/exposure.h"

#include <algorithm>

#include "render/srgb.h"

namespace hysteron::render {
namespace {

// Digits of `index` mirrored at the binary point (van der Corput 1935): 0, 1/2, 1/4, 3/4 ...
double mirrored(int index) {
  double result = 0, weight = 0.5;
  for (; index > 0; index /= 2, weight /= 2) result += weight * (index % 2);
  return result;
}

}  // namespace

Shift pass_shift(int pass, int passes, int samples) {
  const double cell = 1.0 / samples, half = 0.5 / passes;
  return {cell * (static_cast<double>(pass) / passes + half - 0.5), cell * (mirrored(pass) + half - 0.5)};
}

Exposure::Exposure(int width, int height, int supersample)
    : width_(width),
      height_(height),
      supersample_(supersample),
      sum_(4 * static_cast<size_t>(width) * height, 0.0f) {}

void Exposure::add(std::span<const std::uint8_t> rgba) {
  const auto& linear = linear_of_srgb8();
  const int s = supersample_, drawn_rows = height_ * s;
  const size_t row_bytes = 4 * static_cast<size_t>(width_) * s;
  for (int row = 0; row < drawn_rows; ++row) {
    const std::uint8_t* from = &rgba[(drawn_rows - 1 - row) * row_bytes];
    float* to = &sum_[4 * static_cast<size_t>(row / s) * width_];
    for (int x = 0; x < width_; ++x, to += 4)
      for (int i = 0; i < s; ++i, from += 4) {
        for (int c = 0; c < 3; ++c) to[c] += linear[from[c]];
        to[3] += static_cast<float>(from[3]) / 255;
      }
  }
  ++passes_;
}

Image Exposure::image(bool alpha) const {
  Image result(width_, height_, alpha ? 4 : 3);
  const float weight = 1 / static_cast<float>(passes_ * supersample_ * supersample_);
  const float* from = sum_.data();
  for (int y = 0; y < height_; ++y)
    for (int x = 0; x < width_; ++x, from += 4) {
      std::uint8_t* to = result.at(x, y);
      const float share = alpha ? std::max(from[3], 1e-6f) : 1 / weight;  // what colours are multiplied by
      for (int c = 0; c < 3; ++c) to[c] = srgb8_of_linear(from[c] / share);
      if (alpha) to[3] = static_cast<std::uint8_t>(255 * std::min(weight * from[3], 1.0f) + 0.5f);
    }
  return result;
}

}  // namespace hysteron::render
