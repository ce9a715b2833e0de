// Averages what several passes of a driver drew of one picture, in linear light.
#pragma once

#include <span>
#include <vector>

#include "render/image.h"

namespace hysteron::render {

class Exposure {
 public:
  // [pixels] of the picture; `supersample`: drawn pixels a side of each.
  Exposure(int width, int height, int supersample);

  // One pass: RGBA rows from the bottom, as GL reads them, linear light multiplied by alpha.
  void add(std::span<const float> rgba);
  // The mean of the passes: RGB, or with `alpha` RGBA whose colours are no longer multiplied by it.  Rounded
  // with a triangular noise of one step to either side (Lipshitz, Wannamaker and Vanderkooy 1992), so that
  // gradients show no bands; the noise is the same for equal `left`, `top`: the place of this part in the
  // picture.  Pure black and white stay so.
  Image image(bool alpha, int left = 0, int top = 0) const;

 private:
  int width_, height_, supersample_, passes_ = 0;
  std::vector<float> sum_;  // linear light, 4 a pixel, rows from the top
};

inline constexpr double kBell = 0.42;  // standard deviation [pixels]: edges neither stairs nor blurred

// Offset of a pass's samples in pixels.
struct Shift {
  double x, y;
};
// Pass `pass` of `passes`, x or y alike: with `samples` a pixel spread as evenly as drivers do, no two
// samples of all passes share a row or column of the pixel (a rooks' pattern).
Shift pass_shift(int pass, int passes, int samples);
// Of a pixel that is the mean of its passes under a Gaussian bell of kBell pixels: one sample a pass.
Shift bell_shift(int pass, int passes);

// Digits of `index` in `base` mirrored at the point (van der Corput 1935, Halton 1960): 0, 1/2, 1/4, 3/4 ...
double radical_inverse(int index, int base);

}  // namespace hysteron::render
