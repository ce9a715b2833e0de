#include "render/plane.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace hysteron::render {
namespace {

int radius_of(const Kernel& kernel) { return static_cast<int>(kernel.size() / 2); }

constexpr int kStrip = 64;  // [rows] filtered along both axes while they are in the cache

// Whole rows at a time, because that vectorises.
void add_scaled(double weight, const double* from, double* to, int count) {
#pragma omp simd
  for (int i = 0; i < count; ++i) to[i] += weight * from[i];
}

// `padded` has the kernel's radius more than `width` on both sides.
void filter_row(const double* row, int width, const Kernel& kernel, std::vector<double>& padded, double* to) {
  const int radius = radius_of(kernel);
  std::fill_n(padded.begin(), radius, row[0]);
  std::copy_n(row, width, padded.begin() + radius);
  std::fill_n(padded.end() - radius, radius, row[width - 1]);
  for (int k = 0; k <= 2 * radius; ++k) add_scaled(kernel[k], &padded[k], to, width);
}

// Rows [begin, end) of filtered().
void filter_strip(const Plane& plane, const Kernel& x, const Kernel& y, int begin, int end, Plane& result) {
  const int radius = radius_of(y), width = plane.width;
  Plane rows(width, end - begin + 2 * radius);
  std::vector<double> padded(static_cast<size_t>(width) + x.size() - 1);
  for (int j = 0; j < rows.height; ++j)
    filter_row(plane.row(std::clamp(begin - radius + j, 0, plane.height - 1)), width, x, padded, rows.row(j));
  for (int j = begin; j < end; ++j)
    for (int k = 0; k <= 2 * radius; ++k) add_scaled(y[k], rows.row(j - begin + k), result.row(j), width);
}

}  // namespace

double mean(const Plane& plane) {
  return std::accumulate(plane.values.begin(), plane.values.end(), 0.0) /
         static_cast<double>(plane.values.size());
}

Kernel gaussian_kernel(double sigma, int radius) {
  Kernel kernel;
  for (int d = -radius; d <= radius; ++d) kernel.push_back(std::exp(-0.5 * d * d / (sigma * sigma)));
  const double sum = std::accumulate(kernel.begin(), kernel.end(), 0.0);
  for (double& weight : kernel) weight /= sum;
  return kernel;
}

Plane filtered(const Plane& plane, const Kernel& x, const Kernel& y) {
  Plane result(plane.width, plane.height);
#pragma omp parallel for schedule(static) if (plane.height > kStrip)
  for (int begin = 0; begin < plane.height; begin += kStrip)
    filter_strip(plane, x, y, begin, std::min(begin + kStrip, plane.height), result);
  return result;
}

}  // namespace hysteron::render
