// Relief in pictures whose lightness is a formula.
#include "render/local_deviation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "render/lab.h"

namespace hysteron::render {
namespace {

constexpr int kReliefWidth = 80, kReliefHeight = 60;
constexpr double kGreyStep = 0.25;  // of L*, between two greys

// Returns the lightness of each grey.
std::vector<double> grey_lightness() {
  std::vector<double> all;
  for (int g = 0; g < 256; ++g) {
    const auto byte = static_cast<std::uint8_t>(g);
    const Rgb8 grey = {byte, byte, byte};
    all.push_back(lightness(grey.data()));
  }
  return all;
}

// The grey whose lightness is nearest.
Rgb8 grey_of(double wanted) {
  static const std::vector<double> greys = grey_lightness();
  const auto above = std::lower_bound(greys.begin(), greys.end() - 1, wanted);
  const bool below = above != greys.begin() && wanted - *(above - 1) < *above - wanted;
  const auto g = static_cast<std::uint8_t>(above - greys.begin() - below);
  return {g, g, g};
}

Image picture(const std::function<double(int x, int y)>& light) {
  Image image(kReliefWidth, kReliefHeight);
  for (int y = 0; y < kReliefHeight; ++y)
    for (int x = 0; x < kReliefWidth; ++x) {
      const Rgb8 grey = grey_of(light(x, y));
      std::copy(grey.begin(), grey.end(), image.at(x, y));
    }
  return image;
}

std::vector<char> where(const std::function<bool(int x, int y)>& is_there) {
  std::vector<char> mask;
  for (int y = 0; y < kReliefHeight; ++y)
    for (int x = 0; x < kReliefWidth; ++x) mask.push_back(is_there(x, y));
  return mask;
}

const std::vector<char> kEverywhere = where([](int, int) { return true; });

TEST(LocalDeviation, OfASineOfWholeWavesIsItsAmplitudeOverTheRootOfTwo) {
  constexpr double kAmplitude = 15, kWave = 7;  // three of them in 21 pixels
  const Image image =
      picture([&](int x, int) { return 50 + kAmplitude * std::sin(2 * std::numbers::pi * x / kWave); });
  const LocalDeviation found = local_deviation(image, kEverywhere, kEverywhere);
  EXPECT_NEAR(found.median, kAmplitude / std::numbers::sqrt2, kGreyStep);
  EXPECT_EQ(found.pixels, (kReliefWidth - 20) * (kReliefHeight - 20));
}

// A slope has the root of (21^2 - 1)/12 times its rise in a pixel.
TEST(LocalDeviation, OfASlopeIsThatOfItsSquare) {
  const Image image = picture([](int x, int y) { return 20 + 0.5 * x + 0.2 * y; });
  const double rise = std::hypot(0.5, 0.2);
  EXPECT_NEAR(local_deviation(image, kEverywhere, kEverywhere).median, rise * std::sqrt((21 * 21 - 1) / 12.0),
              kGreyStep);
}

TEST(LocalDeviation, IsOfThePartWhereNothingButClothIsNear) {
  const Image image = picture([](int x, int y) {
    if (y >= 50) return 100.0;  // no cloth
    return x < 40 ? 50.0 : 50.0 + (x % 2 ? 10.0 : -10.0);
  });
  const std::vector<char> cloth = where([](int, int y) { return y < 50; });
  const LocalDeviation left = local_deviation(image, cloth, where([](int x, int) { return x < 30; })),
                       right = local_deviation(image, cloth, where([](int x, int) { return x >= 50; }));
  EXPECT_NEAR(left.median, 0, 1e-6);
  EXPECT_EQ(left.pixels, 20 * 30) << "of columns 10 to 29, and rows 10 to 39";
  EXPECT_NEAR(right.median, 10, kGreyStep);
}

TEST(LocalDeviation, OfNoPixelIsNotKnown) {
  EXPECT_TRUE(std::isnan(local_deviation(picture([](int, int) { return 50.0; }), kEverywhere,
                                         where([](int, int) { return false; }))
                             .median));
}

}  // namespace
}  // namespace hysteron::render
