#include "render/plane.h"

#include <gtest/gtest.h>
#include <omp.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace hysteron::render {
namespace {

// 150 rows are more than two strips of the filter.
Plane waves(int width = 37, int height = 150) {
  Plane plane(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) plane.row(y)[x] = std::sin(0.7 * x + 0.01 * x * y) + 0.1 * y;
  return plane;
}

TEST(GaussianKernel, HasUnitSumAndTheRatiosOfTheBellCurve) {
  const Kernel kernel = gaussian_kernel(1.5, 5);
  ASSERT_EQ(kernel.size(), 11u);
  EXPECT_NEAR(std::accumulate(kernel.begin(), kernel.end(), 0.0), 1, 1e-15);
  EXPECT_NEAR(kernel[5 + 3] / kernel[5], std::exp(-9 / (2 * 1.5 * 1.5)), 1e-15);
  EXPECT_EQ(kernel[2], kernel[8]);
}

// The definition, in two nested sums, with the border repeated.
TEST(Filtered, IsTheSumOfWeightedNeighboursUpToTheBorder) {
  const Plane plane = waves();
  const Kernel x = {0.2, -0.5, 1.25, 0.3, 0.1}, y = {-1, 0.5, 0.7};
  const Plane result = filtered(plane, x, y);
  ASSERT_EQ(result.values.size(), plane.values.size());
  for (const auto& [at_x, at_y] : {std::pair{0, 0}, {36, 149}, {1, 63}, {2, 64}, {20, 127}, {36, 128}}) {
    double sum = 0;
    for (int j = -1; j <= 1; ++j)
      for (int i = -2; i <= 2; ++i)
        sum += x[i + 2] * y[j + 1] *
               plane.row(std::clamp(at_y + j, 0, 149))[std::clamp(at_x + i, 0, plane.width - 1)];
    EXPECT_NEAR(result.row(at_y)[at_x], sum, 1e-13) << at_x << ", " << at_y;
  }
}

TEST(Filtered, KernelsMayReachBeyondBothBorders) {
  const Plane plane = waves(3, 2);
  const Kernel wide = gaussian_kernel(4, 10);
  const Plane result = filtered(plane, wide, wide);
  const auto [low, high] = std::minmax_element(plane.values.begin(), plane.values.end());
  for (double value : result.values) {
    EXPECT_GE(value, *low - 1e-12);
    EXPECT_LE(value, *high + 1e-12);
  }
}

TEST(Filtered, HasTheSameBitsOnAnyNumberOfThreads) {
  const Kernel kernel = gaussian_kernel(3, 9);
  const int before = omp_get_max_threads();
  omp_set_num_threads(1);
  const Plane one = filtered(waves(), kernel, kernel);
  omp_set_num_threads(3);
  const Plane three = filtered(waves(), kernel, kernel);
  omp_set_num_threads(before);
  EXPECT_EQ(one.values, three.values);
}

}  // namespace
}  // namespace hysteron::render
