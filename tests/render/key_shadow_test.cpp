// The key light is a disc far away: its shadows' edges are as wide as geometry says.

#include <algorithm>
#include <array>
#include <cmath>

#include "render/srgb.h"
#include "tests/render/test_scene.h"

namespace hysteron::render {
namespace {

constexpr int kSide = 400;
constexpr int kBand = 8;             // half of the rows that are averaged
constexpr float kHalf = 0.12f;       // of what the picture shows [m]
constexpr double kLightSize = 0.06;  // the light's radius over its distance, as in key_shadow.glsl

class KeyShadowTest : public test::OffscreenTest {
 protected:
  // Along rows around the middle, whose mean has no noise of rounding, from above, with the key light alone,
  // from the left at 45 degrees: light per pixel, as a share of the brightest.
  std::vector<double> light_along_x(const test::Cloth& cloth) {
    Look look;
    look.weave = look.sheen = 0;
    look.front = {70, 80, 90};  // so dark that its brightest light is shown in proportion
    look.room = 0;
    look.to_light = {-1, 0, 1};
    const Image image = test::cloth_view(*offscreen_, {kSide, kSide}, cloth, look)->draw(camera_);
    std::vector<double> light;
    for (int x = 0; x < kSide; ++x) {
      double sum = 0;
      for (int y = kSide / 2 - kBand; y < kSide / 2 + kBand; ++y) sum += linear_of_srgb8()[image.at(x, y)[1]];
      light.push_back(sum / (2 * kBand));
    }
    const double most = *std::max_element(light.begin(), light.end());
    for (double& l : light) l /= most;
    return light;
  }

  int pixel(double x) const { return static_cast<int>(std::lround(x / metres_)) + kSide / 2; }

  const Camera camera_ = Camera::top({{-kHalf, -kHalf, 0}, {kHalf, kHalf, kHalf}}, 1);
  const double metres_ = camera_.metres_per_pixel({0, 0, 0}, kSide);
};

// Returns a sheet on z = 0 and another square, of four corners counter-clockwise, in one cloth.
test::Cloth sheet_and(const std::array<Eigen::Vector3f, 4>& corners) {
  test::Cloth cloth = test::flat_square(40, 0.26f, 0.0f);
  const int first = static_cast<int>(cloth.positions.size() / 3);
  for (const Eigen::Vector3f& p : corners)
    cloth.positions.insert(cloth.positions.end(), {p.x(), p.y(), p.z()});
  for (const int k : {0, 1, 2, 0, 2, 3}) cloth.triangles.push_back(first + k);
  return cloth;
}

// Returns a sheet under a roof to the left of x = 0, `height` above the sheet [m].
test::Cloth under_roof(float height) {
  return sheet_and({{{-0.1f, -0.1f, height}, {0, -0.1f, height}, {0, 0.1f, height}, {-0.1f, 0.1f, height}}});
}

// Returns where the light first passes a share, right of pixel `from`, between pixels.
double crossing(const std::vector<double>& light, double fraction, int from) {
  for (size_t x = static_cast<size_t>(from); x + 1 < light.size(); ++x)
    if (light[x] < fraction && light[x + 1] >= fraction)
      return static_cast<double>(x) + (fraction - light[x]) / (light[x + 1] - light[x]);
  return -1;
}

// A straight edge that hides a disc up to t of its radius leaves 1/2 + (t sqrt(1 - t^2) + asin t) / pi of it:
// a tenth to nine tenths between -t and t.
double tenth_to_nine_tenths() {
  double low = 0, high = 1;
  for (int i = 0; i < 50; ++i) {
    const double t = 0.5 * (low + high);
    (0.5 + (t * std::sqrt(1 - t * t) + std::asin(t)) / M_PI < 0.9 ? low : high) = t;
  }
  return 2 * low;
}

// The light falls at 45 degrees: its way is sqrt(2) times the height, and a square across it spans sqrt(2)
// times its side on the sheet.
TEST_F(KeyShadowTest, ThePenumbraWidensWithTheBlockersDistance) {
  // 22 lookups and more stand for the disc and the search's mean distance for the edge's own.
  constexpr double kLookups = 0.12;
  for (const float height : {0.03f, 0.06f, 0.09f}) {
    const std::vector<double> light = light_along_x(under_roof(height));
    const int shadow = pixel(0.4 * height);
    const double width = (crossing(light, 0.9, shadow) - crossing(light, 0.1, shadow)) * metres_;
    const double expected = tenth_to_nine_tenths() * kLightSize * 2 * height;
    EXPECT_NEAR(width, expected, kLookups * expected) << height << " m";
    const double upper_side = 0.6 * metres_;  // of the sheet, drawn 1.2 pixels thick
    EXPECT_NEAR(crossing(light, 0.5, shadow), pixel(height - upper_side), 0.1 * expected / metres_ + 1)
        << height << " m";
  }
}

TEST_F(KeyShadowTest, AnEdgeNearTheSheetIsAsSharpAsTheMap) {
  const std::vector<double> light = light_along_x(under_roof(0.008f));
  const int shadow = pixel(0.001);
  constexpr double kResolved = 2.5e-3;  // [m]: texels of 0.4 mm, lookups over 3 of them, at 45 degrees
  EXPECT_LE((crossing(light, 0.9, shadow) - crossing(light, 0.1, shadow)) * metres_, kResolved);
}

// A wall stands on the sheet: its shadow begins at its foot.
TEST_F(KeyShadowTest, NoLightLeaksWhereAWallStands) {
  const std::vector<double> light =
      light_along_x(sheet_and({{{0, -0.1f, 0}, {0, 0.1f, 0}, {0, 0.1f, 0.08f}, {0, -0.1f, 0.08f}}}));
  for (int x = pixel(0.003); x < pixel(0.06); ++x)
    EXPECT_LE(light[x], 0.02) << (x - kSide / 2) * metres_ << " m";
  for (int x = pixel(0.1); x < kSide; ++x) EXPECT_GE(light[x], 0.98) << (x - kSide / 2) * metres_ << " m";
}

}  // namespace
}  // namespace hysteron::render
