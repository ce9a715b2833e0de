#include "render/ssim.h"

#include <algorithm>

#include "render/compare.h"
#include "render/plane.h"

namespace hysteron::render {
namespace {

constexpr int kRadius = 5;      // [pixels] of the window
constexpr double kSigma = 1.5;  // [pixels] of its weights
constexpr double kRange = 255;  // L, of the values
constexpr double kC1 = (0.01 * kRange) * (0.01 * kRange), kC2 = (0.03 * kRange) * (0.03 * kRange);

// ITU-R BT.601, on encoded values: what pictures are usually turned to grey with for this index.
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

// Wang et al. 2004, Eq. 13.
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
