// Values on the pixels of a picture, and separable filters over them.
#pragma once

#include <cstddef>
#include <vector>

#include "render/image.h"

namespace hysteron::render {

// A plane of width x height values, rows from the top.
struct Plane {
  Plane() = default;
  Plane(int w, int h) : width(w), height(h), values(static_cast<size_t>(w) * static_cast<size_t>(h)) {}

  double* row(int y) { return &values[static_cast<size_t>(y) * static_cast<size_t>(width)]; }
  const double* row(int y) const { return &values[static_cast<size_t>(y) * static_cast<size_t>(width)]; }

  int width = 0, height = 0;
  std::vector<double> values;
};

double mean(const Plane& plane);

// Weights of the values at -radius ... radius from a pixel.
using Kernel = std::vector<double>;

// Returns exp(-d^2 / (2 sigma^2)) for d = -radius ... radius, scaled to sum 1.  sigma is in pixels.
Kernel gaussian_kernel(double sigma, int radius);

// Returns sum_j y(j) sum_i x(i) plane(at x + i, y + j); the border's values are repeated beyond it.  The sums
// have one order, whatever the number of threads.
Plane filtered(const Plane& plane, const Kernel& x, const Kernel& y);

// Structural similarity of two pictures.

// Returns the mean SSIM index (Wang, Bovik, Sheikh, Simoncelli 2004, "Image Quality Assessment: From Error
// Visibility to Structural Similarity", Eq. 13, 17) of the luma Y' = 0.299 R' + 0.587 G' + 0.114 B' of the
// encoded 8-bit values, not rounded: 1 for equal pictures, less for others, at least -1.  Windows have 11 x
// 11 pixels under a Gaussian of sigma 1.5 pixels, with K1 = 0.01, K2 = 0.03, L = 255; the size is not reduced
// beforehand.
//
// Borders: only windows that lie inside the picture count, as in the authors' program; where a side has fewer
// than 11 pixels, the window has the largest odd number of pixels that fits.
// Error::invalid_input if the sizes differ.  Alpha is ignored.
double ssim(const Image& a, const Image& b);

}  // namespace hysteron::render
