// The sRGB transfer function (IEC 61966-2-1:1999) between 8-bit values and linear light.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace hysteron::render {

inline float linear_of_srgb(float encoded) {
  return encoded <= 0.04045f ? encoded / 12.92f : std::pow((encoded + 0.055f) / 1.055f, 2.4f);
}

inline float srgb_of_linear(float light) {
  return light <= 0.0031308f ? 12.92f * light : 1.055f * std::pow(light, 1 / 2.4f) - 0.055f;
}

inline const std::array<float, 256>& linear_of_srgb8() {
  static const std::array<float, 256> table = [] {
    std::array<float, 256> values;
    for (int i = 0; i < 256; ++i) values[i] = linear_of_srgb(static_cast<float>(i) / 255);
    return values;
  }();
  return table;
}

// Returns the encoded value in 256ths of an 8-bit step, 0 to 65280, from a table of 2^16 steps, because
// pictures ask millions of times; it is off by up to 1/40 of an 8-bit step, where the curve is steepest.
inline std::uint16_t srgb16_of_linear(float light) {
  constexpr int kLast = 65535;
  static const std::vector<std::uint16_t> table = [] {
    std::vector<std::uint16_t> values(kLast + 1);
    for (int i = 0; i <= kLast; ++i)
      values[i] =
          // NOLINTNEXTLINE(bugprone-incorrect-roundings): no value is negative
          static_cast<std::uint16_t>(255 * 256 * srgb_of_linear(static_cast<float>(i) / kLast) + 0.5f);
    return values;
  }();
  // NOLINTNEXTLINE(bugprone-incorrect-roundings)
  return table[static_cast<size_t>(kLast * std::clamp(light, 0.0f, 1.0f) + 0.5f)];
}

inline std::uint8_t srgb8_of_linear(float light) {
  return static_cast<std::uint8_t>((srgb16_of_linear(light) + 128) >> 8);
}

}  // namespace hysteron::render
