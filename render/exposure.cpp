#include "render/exposure.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "render/srgb.h"

namespace hysteron::render {
namespace {

// Returns the sum of two numbers from 0 to 255, less 255, which depend on the place alone by integer mixing
// as in weave.glsl.
int triangular_noise(int x, int y, int channel) {
  std::uint32_t h = static_cast<std::uint32_t>(x) * 0x9e3779b9u +
                    static_cast<std::uint32_t>(y) * 0x7f4a7c15u +
                    static_cast<std::uint32_t>(channel) * 0x632be59bu;
  h ^= h >> 16;
  h *= 0x85ebca6bu;
  h ^= h >> 13;
  h *= 0xc2b2ae35u;
  h ^= h >> 16;
  return static_cast<int>(h & 255) + static_cast<int>(h >> 8 & 255) - 255;
}

std::uint8_t rounded(float light, int x, int y, int channel) {
  const int encoded = srgb16_of_linear(light);  // in 256ths of a step
  if (encoded == 0 || encoded == 255 * 256) return static_cast<std::uint8_t>(encoded / 256);
  return static_cast<std::uint8_t>(
      std::clamp((encoded + 128 + triangular_noise(x, y, channel)) >> 8, 0, 255));
}

}  // namespace

double radical_inverse(int index, int base) {
  double result = 0, weight = 1.0 / base;
  for (; index > 0; index /= base, weight /= base) result += weight * (index % base);
  return result;
}

Shift pass_shift(int pass, int passes, int samples) {
  const double cell = 1.0 / samples, half = 0.5 / passes;
  return {cell * (static_cast<double>(pass) / passes + half - 0.5),
          cell * (radical_inverse(pass, 2) + half - 0.5)};
}

Shift bell_shift(int pass, int passes) {
  const double fraction = (pass + 0.5) / passes, angle = 2 * std::numbers::pi * radical_inverse(pass, 2);
  const double radius = kBell * std::sqrt(-2 * std::log(1 - fraction));
  return {radius * std::cos(angle), radius * std::sin(angle)};
}

Exposure::Exposure(int width, int height, int supersample)
    : width_(width),
      height_(height),
      supersample_(supersample),
      sum_(4 * static_cast<size_t>(width) * height, 0.0f) {}

void Exposure::add(std::span<const float> rgba) {
  const int s = supersample_, drawn_rows = height_ * s;
  const size_t row_floats = 4 * static_cast<size_t>(width_) * s;
  for (int row = 0; row < drawn_rows; ++row) {
    const float* from = &rgba[(drawn_rows - 1 - row) * row_floats];
    float* to = &sum_[4 * static_cast<size_t>(row / s) * width_];
    for (int x = 0; x < width_; ++x, to += 4)
      for (int i = 0; i < s; ++i, from += 4)
        for (int c = 0; c < 4; ++c) to[c] += from[c];
  }
  ++passes_;
}

Image Exposure::image(bool alpha, int left, int top) const {
  Image result(width_, height_, alpha ? 4 : 3);
  const float weight = 1 / static_cast<float>(passes_ * supersample_ * supersample_);
  const float* from = sum_.data();
  for (int y = 0; y < height_; ++y)
    for (int x = 0; x < width_; ++x, from += 4) {
      std::uint8_t* to = result.at(x, y);
      const float fraction = alpha ? std::max(from[3], 1e-6f) : 1 / weight;  // factor in the colours
      for (int c = 0; c < 3; ++c) to[c] = rounded(from[c] / fraction, left + x, top + y, c);
      if (alpha) to[3] = static_cast<std::uint8_t>(255 * std::min(weight * from[3], 1.0f) + 0.5f);
    }
  return result;
}

}  // namespace hysteron::render
