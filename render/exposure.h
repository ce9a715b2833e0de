// Averages the passes that a driver drew of one picture, in linear light.
#pragma once

#include <span>
#include <vector>

#include "render/image.h"

namespace hysteron::render {

class Exposure {
 public:
  // Takes the size of the picture [pixels]; `supersample` is the number of drawn pixels along a side of each.
  Exposure(int width, int height, int supersample);

  // Adds one pass: RGBA rows from the bottom, as GL reads them, linear light multiplied by alpha.
  void add(std::span<const float> rgba);
  // Returns the mean of the passes: RGB, or with `alpha` RGBA whose colours are no longer multiplied by it.
  // It is rounded with a triangular noise of one step to either side (Lipshitz, Wannamaker and Vanderkooy
  // 1992), so that gradients show no bands; the noise depends on the pixel's place in the picture alone,
  // where this part begins at `left`, `top`.  Pure black and white stay so.
  Image image(bool alpha, int left = 0, int top = 0) const;

 private:
  int width_, height_, supersample_, passes_ = 0;
  std::vector<float> sum_;  // linear light, 4 values per pixel, rows from the top
};

inline constexpr double kBell = 0.42;  // standard deviation [pixels]: edges are neither stairs nor blurred

// The offset of a pass's samples [pixels].
struct Shift {
  double x, y;
};
// Returns the shift of a pass whose `samples` per pixel are spread as evenly as drivers do: no two samples of
// all passes share a row or column of the pixel (a rooks' pattern).
Shift pass_shift(int pass, int passes, int samples);
// Returns the shift of a pass with one sample per pixel, spread under a Gaussian bell of kBell pixels.
Shift bell_shift(int pass, int passes);

// Returns the digits of `index` in `base` mirrored at the point (van der Corput 1935, Halton 1960): 0, 1/2,
// 1/4, 3/4 ...
double radical_inverse(int index, int base);

}  // namespace hysteron::render
