#include "render/plane.h"

#include <cmath>

#include "tests/render/formula_pictures.h"
#include "tests/render/test_scene.h"

namespace hysteron::render {
namespace {

constexpr double kC1 = 6.5025, kC2 = 58.5225;  // (0.01 * 255)^2, (0.03 * 255)^2

// Wang et al. 2004, Eq. 13 to 16, at one place by their definitions: means first, then central moments.
double index_at(const Image& a, const Image& b, int x, int y) {
  double weights = 0, mean_a = 0, mean_b = 0, var_a = 0, var_b = 0, cov = 0;
  const auto over_window = [&](const auto& body) {
    for (int j = -5; j <= 5; ++j)
      for (int i = -5; i <= 5; ++i) {
        const std::uint8_t *p = a.at(x + i, y + j), *q = b.at(x + i, y + j);
        body(std::exp(-(i * i + j * j) / (2 * 1.5 * 1.5)), 0.299 * p[0] + 0.587 * p[1] + 0.114 * p[2],
             0.299 * q[0] + 0.587 * q[1] + 0.114 * q[2]);
      }
  };
  over_window([&](double w, double u, double v) { weights += w, mean_a += w * u, mean_b += w * v; });
  mean_a /= weights;
  mean_b /= weights;
  over_window([&](double w, double u, double v) {
    var_a += w / weights * (u - mean_a) * (u - mean_a);
    var_b += w / weights * (v - mean_b) * (v - mean_b);
    cov += w / weights * (u - mean_a) * (v - mean_b);
  });
  return (2 * mean_a * mean_b + kC1) * (2 * cov + kC2) /
         ((mean_a * mean_a + mean_b * mean_b + kC1) * (var_a + var_b + kC2));
}

Image image_corner(const Image& image, int width, int height) {
  Image result(width, height);
  paste(result, image, 0, 0);
  return result;
}

TEST(Ssim, IsOneForEqualPicturesOnly) {
  EXPECT_EQ(ssim(test::texture(), test::texture()), 1);
  Image changed = test::texture();
  changed.at(50, 30)[1] ^= 1;
  EXPECT_LT(ssim(test::texture(), changed), 1);
}

// Only the luminance term is left where there is no variance (Wang et al. 2004, Eq. 6).
TEST(Ssim, OfUniformPicturesIsTheLuminanceTerm) {
  const double u = 100, v = 140;
  EXPECT_NEAR(ssim(Image(20, 15, Rgb8{100, 100, 100}), Image(20, 15, Rgb8{140, 140, 140})),
              (2 * u * v + kC1) / (u * u + v * v + kC1), 1e-9);
}

// 13 x 12 pixels have room for 3 x 2 windows: no other place counts, and none is left out.
TEST(Ssim, IsTheMeanOfTheDefinitionOverTheWindowsInside) {
  const Image a = image_corner(test::texture(), 13, 12), b = image_corner(test::noisy_texture(), 13, 12);
  double sum = 0;
  for (int y = 5; y <= 6; ++y)
    for (int x = 5; x <= 7; ++x) sum += index_at(a, b, x, y);
  ASSERT_LT(sum / 6, 0.99);
  EXPECT_NEAR(ssim(a, b), sum / 6, 1e-10);
}

// scikit-image 0.26, structural_similarity(gaussian_weights=True, sigma=1.5, use_sample_covariance=False,
// data_range=255) of the luma in double precision.
TEST(Ssim, AgreesWithScikitImage) {
  constexpr double kDigits = 1e-9;  // recorded
  EXPECT_NEAR(ssim(test::texture(), test::noisy_texture()), 0.864685602, kDigits);
  EXPECT_NEAR(ssim(test::texture(), test::moved_texture()), 0.743806588, kDigits);
  EXPECT_NEAR(ssim(test::first_shapes(), test::second_shapes()), 0.952702637, kDigits);
}

// Opposite pictures have a negative correlation.
TEST(Ssim, IsNegativeWhereStructureIsInverted) {
  const Image a = test::drawn(32, 32, [](int x, int y) {
    const int v = (x + y) % 2 ? 200 : 55;
    return std::array<int, 3>{v, v, v};
  });
  Image b = a;
  for (std::uint8_t& value : b.pixels()) value = static_cast<std::uint8_t>(255 - value);
  EXPECT_LT(ssim(a, b), -0.9);
}

TEST(Ssim, TakesPicturesSmallerThanItsWindow) {
  for (const auto& [width, height] : {std::pair{1, 1}, {3, 40}, {10, 2}}) {
    const Image a = image_corner(test::texture(), width, height),
                b = image_corner(test::noisy_texture(), width, height);
    EXPECT_EQ(ssim(a, a), 1) << width;
    EXPECT_LT(ssim(a, b), 1) << width;
    EXPECT_GT(ssim(a, b), 0) << width;
  }
}

}  // namespace
}  // namespace hysteron::render
