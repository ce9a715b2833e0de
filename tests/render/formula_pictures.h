// Pictures of 96 x 64 pixels by formulas in integers, so that any program can make the same ones: what other
// programs say about their differences is recorded in the tests.
#pragma once

#include <algorithm>

#include "render/image.h"

namespace hysteron::render::test {

inline constexpr int kFormulaWidth = 96, kFormulaHeight = 64;

template <class Formula>
Image drawn(int width, int height, const Formula& formula) {
  Image image(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const std::array<int, 3> color = formula(x, y);
      for (int c = 0; c < 3; ++c) image.at(x, y)[c] = static_cast<std::uint8_t>(std::clamp(color[c], 0, 255));
    }
  return image;
}

inline std::array<int, 3> texture_at(int x, int y) {
  return {(5 * x + 3 * y) % 256, (x * x / 16 + 7 * y) % 256, (x / 8 + y / 8) % 2 == 1 ? 200 : 60};
}

// Returns ramps that wrap around, and a board of squares.
inline Image texture() { return drawn(kFormulaWidth, kFormulaHeight, texture_at); }

// The same with up to 15 steps of grey noise.
inline Image noisy_texture() {
  return drawn(kFormulaWidth, kFormulaHeight, [](int x, int y) {
    std::array<int, 3> color = texture_at(x, y);
    for (int& value : color) value += (73 * x + 151 * y) % 31 - 15;
    return color;
  });
}

// The same, moved right by a pixel; the last column comes in on the left.
inline Image moved_texture() {
  return drawn(kFormulaWidth, kFormulaHeight,
               [](int x, int y) { return texture_at((x + kFormulaWidth - 1) % kFormulaWidth, y); });
}

// Returns a rectangle from `left` on and lone pixels, white and black, on a ramp.
inline Image shapes(int left, const std::array<int, 3>& fill, bool star, int lone) {
  return drawn(kFormulaWidth, kFormulaHeight, [&](int x, int y) -> std::array<int, 3> {
    if (star && x == 10 && y == 10) return {255, 255, 255};
    if (x == 80 && y == 50) return {lone, lone, lone};
    if (x >= left && x < left + 30 && y >= 20 && y < 40) return fill;
    return {60 + x, 90 + y, 120 + (x + y) / 4};
  });
}
inline Image first_shapes() { return shapes(30, {200, 60, 40}, true, 0); }
inline Image second_shapes() { return shapes(31, {190, 70, 40}, false, 255); }

}  // namespace hysteron::render::test
