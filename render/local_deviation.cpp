#include "render/local_deviation.h"

#include <algorithm>
#include <cmath>

#include "render/lab.h"

namespace hysteron::render {
namespace {

// The sums over the rectangle from the picture's first pixel to each.
class Sums {
 public:
  Sums(int width, int height)
      : stride_(width + 1), sum_(static_cast<std::size_t>(stride_) * (height + 1), 0) {}

  void add(int x, int y, double value) { at(x + 1, y + 1) = value + at(x, y + 1) + at(x + 1, y) - at(x, y); }
  // Returns the sum over a square whose first pixel is (x, y).
  double of(int x, int y, int side) const {
    return at(x + side, y + side) - at(x, y + side) - at(x + side, y) + at(x, y);
  }

 private:
  double& at(int x, int y) { return sum_[static_cast<std::size_t>(y) * stride_ + x]; }
  double at(int x, int y) const { return sum_[static_cast<std::size_t>(y) * stride_ + x]; }

  int stride_;
  std::vector<double> sum_;
};

}  // namespace

LocalDeviation local_deviation(const Image& image, const std::vector<char>& cloth,
                               const std::vector<char>& part, int side) {
  const int width = image.width(), height = image.height(), half = side / 2;
  constexpr double kMiddle = 50;  // subtracted from L*, because differences of sums lose digits
  Sums count(width, height), light(width, height), square(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const bool counts = cloth[static_cast<std::size_t>(y) * width + x] != 0;
      const double value = counts ? lightness(image.at(x, y)) - kMiddle : 0;
      count.add(x, y, counts);
      light.add(x, y, value);
      square.add(x, y, value * value);
    }
  std::vector<double> deviations;
  const double all = static_cast<double>(side) * side;
  for (int y = 0; y + side <= height; ++y)
    for (int x = 0; x + side <= width; ++x) {
      if (!part[static_cast<std::size_t>(y + half) * width + x + half] || count.of(x, y, side) < all)
        continue;
      const double mean = light.of(x, y, side) / all;
      deviations.push_back(std::sqrt(std::max(square.of(x, y, side) / all - mean * mean, 0.0)));
    }
  if (deviations.empty()) return {NAN, 0};
  const auto middle = deviations.begin() + static_cast<long>(deviations.size() / 2);
  std::nth_element(deviations.begin(), middle, deviations.end());
  return {*middle, static_cast<long>(deviations.size())};
}

}  // namespace hysteron::render
