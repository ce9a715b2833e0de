// Numbers on the pixels of a picture, and separable filters over them.
#pragma once

#include <cstddef>
#include <vector>

namespace hysteron::render {

// width x height values, rows from the top.
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

// exp(-d^2 / (2 sigma^2)) for d = -radius ... radius, scaled to sum 1.  sigma in pixels.
Kernel gaussian_kernel(double sigma, int radius);

// sum_j y(j) sum_i x(i) plane(at x + i, y + j); the border's values go on beyond it.  The sums have one
// order, whatever the number of threads.
Plane filtered(const Plane& plane, const Kernel& x, const Kernel& y);

}  // namespace hysteron::render
