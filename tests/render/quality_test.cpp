// Pictures for a paper have true lengths, sky light that obstacles occlude, and transparent backgrounds.

#include <cmath>
#include <numbers>

#include "render/caption.h"
#include "render/compare.h"
#include "render/srgb.h"
#include "tests/render/test_scene.h"

namespace hysteron::render {
namespace {

constexpr int kQualityPicture = 240;

class QualityTest : public test::OffscreenTest {
 protected:
  std::unique_ptr<ClothView> viewed_cloth(const test::Cloth& cloth, const Look& look) {
    return test::cloth_view(*offscreen_, {kQualityPicture, kQualityPicture}, cloth, look);
  }
};

// Columns that a dark square covers, the edges' by their share of light.
double covered_width(const Image& silhouette, int row) {
  double width = 0;
  for (int x = 0; x < silhouette.width(); ++x) width += 1 - linear_of_srgb8()[silhouette.at(x, row)[1]];
  return width;
}

// A square across the view spans as many pixels as the scale bar for its plane says, from near, from far and
// from above: its bar is right to a pixel.
TEST_F(QualityTest, TheScaleBarHoldsInThePlaneThatItNames) {
  constexpr float kLength = 0.2f;
  const auto view = viewed_cloth(test::flat_square(2, kLength, 0.03f), look_named("silhouette"));
  const Eigen::Vector3f middle(0, 0, 0.03f);
  for (const Camera& camera :
       {Camera::top({{-0.15f, -0.15f, 0}, {0.15f, 0.15f, 0.1f}}, 1),
        Camera::perspective({0, 0, 0.8f}, middle, 30), Camera::perspective({0, 0, 0.4f}, middle, 60)}) {
    const double metres = camera.metres_per_pixel(middle, kQualityPicture);
    constexpr double kEdges = 0.25;  // pixels: two edges of an eighth
    EXPECT_NEAR(covered_width(view->draw(camera), kQualityPicture / 2), kLength / metres, kEdges);
    Image image(kQualityPicture, kQualityPicture);
    EXPECT_NEAR(draw_scale_bar(image, metres, Corner::bottom_left), scale_bar_length(image, metres) / metres,
                1);
  }
}

// View factor from a horizontal element to a wall of height `height` that begins at the element's foot point,
// `width` to one side, `distance` away (Howell, A Catalog of Radiation Heat Transfer Configuration Factors,
// B-4).
double wall_view(double height, double width, double distance) {
  const double x = height / width, y = distance / width, a = std::sqrt(x * x + y * y);
  return (std::atan(1 / y) - y / a * std::atan(1 / a)) / (2 * std::numbers::pi);
}

// With the key light off, open ground is white and the ground before a wall is as bright as the share of sky
// that the wall leaves.
TEST_F(QualityTest, TheGroundBeforeAWallSeesWhatTheWallLeavesOfTheSky) {
  constexpr float kHalf = 0.15f, kHeight = 0.2f, kThick = 0.01f;
  Look look;
  look.background = Background::white;
  look.room = 19.0f / 9;  // the key light's 1.9 - 0.9 room is 0
  ClothView view(*offscreen_, {kQualityPicture, kQualityPicture});
  view.set_look(look);
  view.set_ground(0.0f);
  view.add_obstacle(box_mesh({kHalf, kThick, kHeight / 2}, 0.001f), placed({0, 0, kHeight / 2}, {0, 0, 1}));
  const Camera camera = Camera::top({{-0.25f, -0.25f, 0}, {0.25f, 0.25f, kHeight}}, 1);
  const double metres = camera.metres_per_pixel({0, 0, 0}, kQualityPicture);
  const Image image = view.draw(camera);
  for (const double distance : {0.02, 0.04, 0.08, 0.15}) {
    const int row = kQualityPicture / 2 + static_cast<int>(std::lround((kThick + distance) / metres));
    const double seen = linear_of_srgb8()[image.at(kQualityPicture / 2, row)[1]];
    constexpr double kDirections = 0.05;   // 24 directions stand for the hemisphere
    constexpr double kShadowDepth = 0.62;  // as in fade.glsl
    EXPECT_NEAR(seen, 1 - kShadowDepth * 2 * wall_view(kHeight, kHalf, distance), kDirections)
        << distance << " m";
  }
}

// Pleats without key light: valleys see less of the room than ridges.
TEST_F(QualityTest, FoldsAreDarkInTheirDepth) {
  test::Cloth cloth = test::flat_square(120, 0.2f, 0.0f);
  constexpr float kPleat = 0.04f;
  for (size_t i = 0; i < cloth.positions.size(); i += 3)
    cloth.positions[i + 2] = 0.015f * std::cos(2 * std::numbers::pi_v<float> * cloth.positions[i] / kPleat);
  Look look;
  look.weave = 0;
  look.room = 19.0f / 9;
  const Camera camera = Camera::top({{-0.06f, -0.06f, 0}, {0.06f, 0.06f, 0}}, 1);
  const Image image = viewed_cloth(cloth, look)->draw(camera);
  const auto half_pleat =
      static_cast<int>(0.5 * kPleat / camera.metres_per_pixel({0, 0, 0}, kQualityPicture));
  const double ridge = linear_of_srgb8()[image.at(kQualityPicture / 2, kQualityPicture / 2)[1]];
  const double valley = linear_of_srgb8()[image.at(kQualityPicture / 2 + half_pleat, kQualityPicture / 2)[1]];
  EXPECT_LT(valley, 0.75 * ridge);
}

// Flat cloth whose threads run askew, its middle at (x, 0, 0).
test::Cloth askew(float x) {
  test::Cloth cloth = test::flat_square(4, 1.0f, 0.0f);
  for (size_t i = 0; i < cloth.positions.size(); i += 3) {
    const float u = cloth.positions[i], v = cloth.positions[i + 1];
    cloth.pattern.insert(cloth.pattern.end(), {0.96f * u + 0.28f * v, -0.28f * u + 0.96f * v});
    cloth.positions[i] += x;
  }
  return cloth;
}

// Returns a square of `half` half width around the cloth's middle, from above or tilted by 0.9 rad.
Image close_up(Offscreen& offscreen, float x, float half, bool tilted, const PictureSize& size) {
  const auto view = test::cloth_view(offscreen, size, askew(x), {});
  view->set_bounds({{x - 0.5f, -0.5f, 0}, {x + 0.5f, 0.5f, 0.1f}});
  const float distance = half / std::tan(10 * std::numbers::pi_v<float> / 180);
  const Eigen::Vector3f back(0, -std::sin(0.9f), std::cos(0.9f));
  return view->draw(tilted ? Camera::perspective(Eigen::Vector3f(x, 0, 0) + distance * back, {x, 0, 0}, 20)
                           : Camera::top({{x - half, -half, 0}, {x + half, half, 0}}, 1));
}

double mean_light(const Image& image, int left, int top, int side) {
  double sum = 0;
  for (int y = top; y < top + side; ++y)
    for (int x = left; x < left + side; ++x) sum += linear_of_srgb8()[image.at(x, y)[1]];
  return sum / (side * side);
}

// From a thread over 7 pixels to 7 threads in a pixel: over blocks of 16 pixels the light is that of a
// picture with 36 times the samples.  Moire, or threads that darken as they come into sight, would show here.
TEST_F(QualityTest, ThreadsMakeNoMoireAndDoNotDarken) {
  constexpr int kPixels = 96, kBlock = 16;
  constexpr double kWhole = 0.01;
  // Where single threads are not resolved, their unevenness is missing too (a factor of 1 +- 0.065): 4 % of a
  // block.
  constexpr double kFraction = 0.05;
  for (const bool tilted : {false, true})
    for (const float threads : {0.15f, 0.25f, 0.35f, 0.5f, 0.7f, 1.0f, 1.5f, 3.0f, 7.0f}) {
      const float half = 0.5f * threads * Look{}.thread_spacing * kPixels;
      const Image image = close_up(*offscreen_, 0, half, tilted, {kPixels, kPixels});
      const Image fine = close_up(*offscreen_, 0, half, tilted, {kPixels, kPixels, 8, 6});
      const double whole = mean_light(fine, 0, 0, kPixels);
      EXPECT_NEAR(mean_light(image, 0, 0, kPixels), whole, kWhole * whole) << threads << " threads a pixel";
      for (int y = 0; y < kPixels; y += kBlock)
        for (int x = 0; x < kPixels; x += kBlock) {
          const double expected = mean_light(fine, x, y, kBlock);
          EXPECT_NEAR(mean_light(image, x, y, kBlock), expected, kFraction * expected)
              << threads << " threads a pixel, block at " << x << ", " << y << (tilted ? ", tilted" : "");
        }
    }
}

TEST_F(QualityTest, ThreadsBelongToTheClothNotToTheWorld) {
  const PictureSize size{96, 96};
  const Difference difference =
      compare(close_up(*offscreen_, 0, 0.004f, true, size), close_up(*offscreen_, 0.25f, 0.004f, true, size));
  EXPECT_LE(difference.mean_abs, 0.1);
  EXPECT_LE(difference.pixels_over_8_percent, 0.1);
}

Image over_white(const Image& layer) {
  Image page(layer.width(), layer.height(), Rgb8{255, 255, 255});
  paste(page, layer, 0, 0);
  return page;
}

Image draped(Offscreen& offscreen, Background background) {
  Look look;
  look.background = background;
  return test::draped_picture(offscreen, {320, 180}, look);
}

// Laid over white, the transparent picture is the white one: cloth and shadow alike.  Edges are blended in
// linear light here and in encoded values there, which differs in the pixels along them.
TEST_F(QualityTest, ATransparentPictureOverWhiteIsTheWhiteOne) {
  const Image layer = draped(*offscreen_, Background::transparent),
              page = draped(*offscreen_, Background::white);
  ASSERT_EQ(layer.channels(), 4);
  ASSERT_EQ(page.channels(), 3);
  EXPECT_EQ(layer.at(0, 0)[3], 0) << "nothing stands in the corner";
  EXPECT_EQ(layer.at(160, 80)[3], 255) << "cloth";
  const Image laid = over_white(layer);
  int edges = 0, shadow = 0;
  for (int y = 0; y < page.height(); ++y)
    for (int x = 0; x < page.width(); ++x) {
      int off = 0;
      for (int c = 0; c < 3; ++c) off = std::max(off, std::abs(laid.at(x, y)[c] - page.at(x, y)[c]));
      edges += off > 2;
      shadow += layer.at(x, y)[3] > 30 && layer.at(x, y)[3] < 200;
    }
  EXPECT_GT(shadow, 1000);
  EXPECT_LT(edges, 0.015 * page.width() * page.height());
}

// The colour of a half covered pixel is the cloth's: no rim of the colour that was cleared.
TEST_F(QualityTest, TransparentEdgesKeepTheClothsColour) {
  Look look;
  look.front = {200, 60, 60};
  look.weave = 0;
  look.to_light = {0, 0, 1};
  look.background = Background::transparent;
  test::Cloth cloth = test::flat_square(2, 0.2f, 0.0f);
  for (size_t i = 0; i < cloth.positions.size(); i += 3) cloth.positions[i + 1] -= 0.1f * cloth.positions[i];
  const Image image =
      viewed_cloth(cloth, look)->draw(Camera::top({{-0.12f, -0.12f, 0}, {0.12f, 0.12f, 0}}, 1));
  const std::uint8_t* cloth_color = image.at(kQualityPicture / 2, kQualityPicture / 2);
  int partly = 0;
  for (int y = 0; y < kQualityPicture; ++y)
    for (int x = 0; x < kQualityPicture; ++x) {
      const std::uint8_t* p = image.at(x, y);
      if (p[3] < 30 || p[3] == 255) continue;
      ++partly;
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(p[c], cloth_color[c], 8);
    }
  EXPECT_GT(partly, 100);
}

}  // namespace
}  // namespace hysteron::render
