// A figure has light that models the cloth, shadows without steps, a page that stays white, and edges as
// thick as the cloth.

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "render/lab.h"
#include "render/srgb.h"
#include "tests/render/test_scene.h"

namespace hysteron::render {
namespace {

constexpr int kWidth = 320, kHeight = 180, kPasses = 16;

// The q-th share of the values from below.
double quantile(std::vector<double> values, double q) {
  const auto at = values.begin() + static_cast<long>(q * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

class FigureTest : public test::OffscreenTest {
 protected:
  Image figure(const Look& look, int passes = kPasses) {
    return test::draped_picture(*offscreen_, {.width = kWidth, .height = kHeight, .figure_passes = passes},
                                look);
  }
  // Where the cloth is wholly in a pixel.
  std::vector<double> on_cloth(const Image& image) {
    const Image where = test::draped_picture(*offscreen_, {kWidth, kHeight}, look_named("silhouette"));
    std::vector<double> values;
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x)
        if (where.at(x, y)[1] == 0) values.push_back(lightness(image.at(x, y)));
    return values;
  }
};

TEST_F(FigureTest, RakingLightIsStrongerAndLeavesNoBlack) {
  Look look;
  look.raking = true;
  look.room = 0.45f;
  const std::vector<double> cloth = on_cloth(figure(look));
  EXPECT_GE(quantile(cloth, 0.95) - quantile(cloth, 0.05), 35);
  constexpr double kBlack = 12;  // L*
  EXPECT_GE(quantile(cloth, 0.01), kBlack);
}

void expect_white_edges(const Image& image) {
  for (int x = 0; x < kWidth; ++x)
    for (const int y : {0, kHeight - 1})
      for (int c = 0; c < 3; ++c) ASSERT_EQ(image.at(x, y)[c], 255) << x << ", " << y;
  for (int y = 0; y < kHeight; ++y)
    for (const int x : {0, kWidth - 1})
      for (int c = 0; c < 3; ++c) ASSERT_EQ(image.at(x, y)[c], 255) << x << ", " << y;
}

// A pixel that is neither cloth nor pedestal is ground: drawn again without both, the page is white there.
TEST_F(FigureTest, StudioLightModelsClothOnAWhitePageLighterThanIt) {
  const Image image = figure({});
  const std::vector<double> cloth = on_cloth(image);
  EXPECT_GE(quantile(cloth, 0.95) - quantile(cloth, 0.05), 30);
  expect_white_edges(image);
  Look hidden;
  hidden.front = hidden.back = hidden.obstacle = {255, 0, 0};
  const Image marked = figure(hidden, 4);
  std::vector<double> ground;
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x)
      if (marked.at(x, y)[2] > 60) ground.push_back(lightness(image.at(x, y)));
  ASSERT_GT(ground.size(), 1000u);
  constexpr double kContact = 0.01;  // of the ground: where the pedestal stands on it
  EXPECT_GE(quantile(ground, kContact), quantile(cloth, 0.5) + 8);
}

// Between the shadow's umbra and open ground, under a sheet: lightness along a line, less the cubic that fits
// it best, has no steps.
double roughness(const std::vector<double>& y) {
  Eigen::MatrixXd powers(static_cast<long>(y.size()), 4);
  for (long i = 0; i < powers.rows(); ++i) {
    const double t = 2.0 * static_cast<double>(i) / static_cast<double>(powers.rows() - 1) - 1;
    powers.row(i) << 1, t, t * t, t * t * t;
  }
  const Eigen::Map<const Eigen::VectorXd> values(y.data(), powers.rows());
  const Eigen::VectorXd normal = (powers.transpose() * powers).inverse() * (powers.transpose() * values);
  return (values - powers * normal).norm() / std::sqrt(static_cast<double>(powers.rows()));
}

// Lightness of columns, each the mean over a band of rows: the noise of rounding is gone, steps remain.
TEST_F(FigureTest, ShadowsHaveNoSteps) {
  constexpr int kSide = 300, kBand = 24;
  const auto view = test::cloth_view(*offscreen_, {.width = kSide, .height = kSide, .figure_passes = kPasses},
                                     test::flat_square(8, 0.12f, 0.12f), {});
  view->set_ground(0.0f);
  // The camera is below the sheet's height and sees the ground behind it.
  const Image image = view->draw(Camera::perspective({0, -0.9f, 0.35f}, {0, 0, 0.03f}, 26));
  const auto columns = [&](int left, int right, int top) {
    std::vector<double> values;
    for (int x = left; x < right; ++x) {
      double sum = 0;
      for (int y = top; y < top + kBand; ++y) sum += lightness(image.at(x, y));
      values.push_back(sum / kBand);
    }
    return values;
  };
  EXPECT_LE(roughness(columns(60, 240, 200)), 0.25) << "across the shadow";
  EXPECT_LE(roughness(columns(60, 240, 250)), 0.10) << "on open ground";
}

// A sheet seen along its plane: as thick as it is, where that is more than the least.
TEST_F(FigureTest, AnEdgeIsAsThickAsTheCloth) {
  constexpr int kSide = 200;
  constexpr float kHalf = 0.02f;
  Look look;
  look.to_light = {0, -1, 1};
  const Camera camera = Camera::perspective({0, -0.4f, 0.01f}, {0, 0, 0.01f}, 6);
  const double metres = camera.metres_per_pixel({0, -kHalf, 0.01f}, kSide);
  for (const double pixels : {0.3, 2.0, 5.0}) {
    look.thickness = static_cast<float>(pixels * metres);
    const Image image =
        test::cloth_view(*offscreen_, {.width = kSide, .height = kSide, .figure_passes = kPasses},
                         test::flat_square(4, 2 * kHalf, 0.01f), look)
            ->draw(camera);
    const double edge = linear_of_srgb8()[image.at(kSide / 2, kSide / 2)[0]];
    double covered = 0;
    for (int y = 0; y < kSide; ++y) covered += 1 - linear_of_srgb8()[image.at(kSide / 2, y)[0]];
    const double expected = std::max(pixels, 1.2);
    EXPECT_NEAR(covered / (pixels < 1.5 ? 1 : 1 - edge), expected, pixels < 1.5 ? 0.9 : 0.5) << pixels;
    EXPECT_GE(covered, 0.3) << "an edge must be seen";
  }
}

}  // namespace
}  // namespace hysteron::render
