#include "render/plane.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "render/compare.h"

namespace hysteron::render {

namespace {

int kernel_radius(const Kernel& kernel) { return static_cast<int>(kernel.size() / 2); }

constexpr int kStrip = 64;  // rows that are filtered along both axes while in the cache

// Adds whole rows at a time, because that vectorises.
void add_scaled(double weight, const double* from, double* to, int count) {
#pragma omp simd
  for (int i = 0; i < count; ++i) to[i] += weight * from[i];
}

// `padded` has the kernel's radius more than `width` on both sides.
void filter_row(const double* row, int width, const Kernel& kernel, std::vector<double>& padded, double* to) {
  const int radius = kernel_radius(kernel);
  std::fill_n(padded.begin(), radius, row[0]);
  std::copy_n(row, width, padded.begin() + radius);
  std::fill_n(padded.end() - radius, radius, row[width - 1]);
  for (int k = 0; k <= 2 * radius; ++k) add_scaled(kernel[k], &padded[k], to, width);
}

// Computes rows [begin, end) of filtered().
void filter_strip(const Plane& plane, const Kernel& x, const Kernel& y, int begin, int end, Plane& result) {
  const int radius = kernel_radius(y), width = plane.width;
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

namespace {

constexpr int kRadius = 5;      // radius of the window [pixels]
constexpr double kSigma = 1.5;  // width of its weights [pixels]
constexpr double kRange = 255;  // L, range of the values
constexpr double kC1 = (0.01 * kRange) * (0.01 * kRange), kC2 = (0.03 * kRange) * (0.03 * kRange);

// Returns the luma of ITU-R BT.601 from encoded values, the grey that is usual for this index.
Plane luma(const Image& image) {
  Plane result(image.width(), image.height());
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x) {
      const std::uint8_t* p = image.at(x, y);
      result.row(y)[x] = 0.299 * p[0] + 0.587 * p[1] + 0.114 * p[2];
    }
  return result;
}

Plane product(const Plane& a, const Plane& b) {
  Plane result(a.width, a.height);
  for (size_t i = 0; i < result.values.size(); ++i) result.values[i] = a.values[i] * b.values[i];
  return result;
}

// Returns the index of Wang et al. 2004, Eq. 13.
double index(double mean_a, double mean_b, double square_a, double square_b, double cross) {
  const double variance_a = square_a - mean_a * mean_a, variance_b = square_b - mean_b * mean_b;
  const double covariance = cross - mean_a * mean_b;
  return (2 * (mean_a * mean_b) + kC1) * (2 * covariance + kC2) /
         ((mean_a * mean_a + mean_b * mean_b + kC1) * (variance_a + variance_b + kC2));
}

}  // namespace

double ssim(const Image& a, const Image& b) {
  require_same_size(a, b);
  const int across = std::min(kRadius, (a.width() - 1) / 2), down = std::min(kRadius, (a.height() - 1) / 2);
  const Kernel x = gaussian_kernel(kSigma, across), y = gaussian_kernel(kSigma, down);
  const auto windowed = [&](const Plane& plane) { return filtered(plane, x, y); };
  const Plane luma_a = luma(a), luma_b = luma(b);
  const Plane mean_a = windowed(luma_a), mean_b = windowed(luma_b);
  const Plane square_a = windowed(product(luma_a, luma_a)), square_b = windowed(product(luma_b, luma_b)),
              cross = windowed(product(luma_a, luma_b));
  double sum = 0;
  for (int j = down; j < a.height() - down; ++j)
    for (int i = across; i < a.width() - across; ++i)
      sum +=
          index(mean_a.row(j)[i], mean_b.row(j)[i], square_a.row(j)[i], square_b.row(j)[i], cross.row(j)[i]);
  return sum / (static_cast<double>(a.width() - 2 * across) * (a.height() - 2 * down));
}

}  // namespace hysteron::render
