// A picture must not add to what it shows: no stairs along edges, no bands in gradients, no gap below cloth
// that lies on the ground, no colours that are not those of the bar.

#include <algorithm>
#include <cmath>

#include "render/comparison_sheet.h"
#include "render/lab.h"
#include "tests/render/test_scene.h"

namespace hysteron::render {
namespace {

constexpr int kFigure = 16;  // passes; 0: a picture of a sequence

class FidelityTest : public test::OffscreenTest {
 protected:
  Image draped(const Look& look, int passes, int width = 320) const {
    return test::draped_picture(*offscreen_,
                                {.width = width, .height = width * 9 / 16, .figure_passes = passes}, look);
  }
};

// Edges are smooth, and sixteen passes have directions enough.  The reference has 64: against one of 256,
// which takes a minute, edges differ by 1.3.
TEST_F(FidelityTest, SixteenPassesOfAFigureAreEnough) {
  constexpr int kSide = 160;
  const Image image = draped({}, kFigure, kSide), reference = draped({}, 4 * kFigure, kSide),
              where = draped(look_named("silhouette"), 0, kSide);
  double at_edges = 0, lighter = 0;
  int edges = 0;
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x) {
      lighter += lightness(image.at(x, y)) - lightness(reference.at(x, y));
      if (where.at(x, y)[1] == 0 || where.at(x, y)[1] == 255) continue;
      at_edges += delta_e(image.at(x, y), reference.at(x, y));
      ++edges;
    }
  ASSERT_GT(edges, 100);
  EXPECT_LE(at_edges / edges, 1.5);
  EXPECT_LE(std::abs(lighter / (image.width() * image.height())), 0.3);
}

// Squares of 7 x 7 pixels of one colour, but for pure white and black: an eye sees a step of the gradient
// there.
int plateaus(const Image& image) {
  constexpr int kSide = 7;
  int found = 0;
  for (int y = 0; y + kSide <= image.height(); ++y)
    for (int x = 0; x + kSide <= image.width(); ++x) {
      const std::uint8_t* first = image.at(x, y);
      if (first[1] == 255 || first[1] == 0) continue;
      bool flat = true;
      for (int i = 0; flat && i < kSide * kSide; ++i)
        flat = image.at(x + i % kSide, y + i / kSide)[1] == first[1];
      found += flat;
    }
  return found;
}

// The picture is checked as drawn, and as a sheet shows it.
TEST_F(FidelityTest, GradientsHaveNoPlateauWiderThanSixPixels) {
  for (const int passes : {0, kFigure}) {
    Image image = draped({}, passes);
    EXPECT_EQ(plateaus(image), 0) << passes;
    fade_to_page(image);
    EXPECT_EQ(plateaus(image), 0) << passes << ", faded";
    EXPECT_EQ(plateaus(shrink(image, 240, 135)), 0) << passes << ", shrunk";
  }
}

// A sheet whose middle rests a thickness above the ground, seen from little above it: the ground begins where
// its lower side ends, and nothing between them is darker than its rim.
TEST_F(FidelityTest, AFlatSpecimenLiesOnTheGroundWithoutAGap) {
  constexpr int kSide = 200;
  constexpr float kHalf = 0.02f;
  constexpr double kRounding = 2;  // L*, of one pixel with the noise of rounding
  const Camera camera = Camera::perspective({0, -0.4f, 0.06f}, {0, -kHalf, 0}, 6);
  const double metres = camera.metres_per_pixel({0, -kHalf, 0}, kSide);
  for (const int passes : {0, kFigure})
    for (const double pixels : {3.0, 8.0}) {
      Look look;
      look.thickness = static_cast<float>(pixels * metres);
      const auto view =
          test::cloth_view(*offscreen_, {.width = kSide, .height = kSide, .figure_passes = passes},
                           test::flat_square(4, 2 * kHalf, look.thickness), look);
      view->set_ground(0.0f);
      const Image image = view->draw(camera);
      const auto at = [&](int row) { return lightness(image.at(kSide / 2, row)); };
      const std::vector<float> foot = {0, -kHalf, 0.5f * look.thickness};
      const double edge = kSide * (1 - camera.image_window(foot, 1).top);
      const int first = static_cast<int>(edge - 0.5 * pixels), last = static_cast<int>(edge) + 6;
      const double rim = at(first), between = 0.5 * (rim + at(last));
      int row = first;
      for (; at(row) < between; ++row) EXPECT_GE(at(row), rim - kRounding) << passes << ", " << pixels;
      const double found = row - 0.5 + (between - at(row - 1)) / (at(row) - at(row - 1));
      EXPECT_NEAR(found, edge, 0.5) << passes << ", " << pixels;
      for (; row < last; ++row) EXPECT_GE(at(row + 1), at(row) - kRounding) << passes << ", " << pixels;
    }
}

// A figure's pixels show a little of their neighbours.
bool is_within(const Image& silhouette, int x, int y) {
  for (int i = -1; i <= 1; ++i)
    for (int j = -1; j <= 1; ++j)
      if (silhouette.at(x + i, y + j)[1] != 0) return false;
  return true;
}

// The colours hold wherever the cloth faces, and in either light.
TEST_F(FidelityTest, FieldsKeepTheColoursOfTheBar) {
  constexpr int kWidth = 160, kHeight = 90;
  Look look = look_named("curvature");
  const std::size_t vertices = test::draped_disc(40, 120).values.size();
  const Image where = draped(look_named("silhouette"), 0, kWidth);
  for (const bool raking : {false, true})
    for (const int passes : {0, 4}) {
      look.raking = raking;
      look.room = raking ? 0.45f : 1;
      const auto view =
          test::draped_view(*offscreen_, {.width = kWidth, .height = kHeight, .figure_passes = passes}, look);
      view->show_obstacle(0, false);
      for (const float value : {-1.0f, 0.0f, 0.5f, 1.0f}) {
        view->set_values(std::vector<float>(vertices, value));
        const Image image = view->draw(test::draped_camera(16.0f / 9));
        const Rgb8 expected = map_color8(look.map, 0.5f * (value + 1));
        double most = 0;
        for (int y = 1; y + 1 < kHeight; ++y)
          for (int x = 1; x + 1 < kWidth; ++x)
            if (is_within(where, x, y)) most = std::max(most, delta_e(image.at(x, y), expected.data()));
        EXPECT_LE(most, 5) << value << ", " << passes << " passes, raking " << raking;
      }
    }
}

}  // namespace
}  // namespace hysteron::render
