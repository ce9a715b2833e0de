// Averages what several passes of a driver drew of one picture, in linear light.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "render/image.h"

namespace hysteron::render {

class Exposure {
 public:
  // [pixels] of the picture; `supersample`: drawn pixels a side of each.
  Exposure(int width, int height, int supersample);

  // One pass: RGBA rows from the bottom, as GL reads them, colours sRGB-encoded and multiplied by alpha.
  void add(std::span<const std::uint8_t> rgba);
  // The mean of the passes: RGB, or with `alpha` RGBA whose colours are no longer multiplied by it.
  Image image(bool alpha) const;

 private:
  int width_, height_, supersample_, passes_ = 0;
  std::vector<float> sum_;  // linear light, 4 a pixel, rows from the top
};

// Offset of pass `pass` of `passes` in pixels, x or y alike: with `samples` a pixel spread as evenly as
// drivers do, no two samples of all passes share a row or column of the pixel (a rooks' pattern).
struct Shift {
  double x, y;
};
Shift pass_shift(int pass, int passes, int samples);

}  // namespace hysteron::render
