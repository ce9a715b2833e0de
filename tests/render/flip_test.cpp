#include "render/flip.h"

#include <algorithm>
#include <cmath>

#include "render/color_map.h"
#include "tests/render/formula_pictures.h"
#include "tests/render/test_scene.h"

namespace hysteron::render {
namespace {

// The authors' program, flip-evaluator 1.7, has single precision.  It sees some 1e-7 of the luminance as an
// edge where there is none, and the square root of that acts on the error.
constexpr double kSinglePrecision = 3e-6, kSinglePrecisionUniform = 5e-5;
constexpr double kTableWhite = 5e-5;  // tables of L*a*b* have a white with other digits

Image uniform(const Rgb8& color) { return Image(24, 16, color); }

TEST(Flip, OfEqualPicturesIsZeroEverywhere) {
  const Plane map = flip_map(test::texture(), test::texture());
  EXPECT_EQ(*std::max_element(map.values.begin(), map.values.end()), 0);
}

// L*a*b* of sRGB's green and blue are from tables.
double largest_hyab() {
  const double green[] = {87.7347, -86.1827, 83.1793}, blue[] = {32.2970, 79.1875, -107.8602};
  const double g = 0.01 * green[0], b = 0.01 * blue[0];  // Hunt
  return std::abs(green[0] - blue[0]) + std::hypot(g * green[1] - b * blue[1], g * green[2] - b * blue[2]);
}

// Filters keep uniform pictures and find no features, so that the colour part is all there is (Andersson et
// al. 2020, colour pipeline): lightness 0 and 100 give HyAB = 100, beyond the knee.
TEST(Flip, OfBlackAndWhiteIsTheRedistributedLightness) {
  const double knee = 0.4 * std::pow(largest_hyab(), 0.7), difference = std::pow(100, 0.7);
  ASSERT_GT(difference, knee);
  const double expected = 0.95 + 0.05 * (difference - knee) / (knee / 0.4 - knee);
  EXPECT_NEAR(flip(uniform({0, 0, 0}), uniform({255, 255, 255})), expected, kTableWhite);
}

// Grey 119 has L* = 116 cbrt(Y) - 16 = 50.03; below the knee the error is proportional to the 0.7th power.
TEST(Flip, OfTwoGreysIsTheLinearPiece) {
  const auto lightness = [](double encoded) {
    return 116 * std::cbrt(std::pow((encoded / 255 + 0.055) / 1.055, 2.4)) - 16;
  };
  const double knee = 0.4 * std::pow(largest_hyab(), 0.7),
               difference = std::pow(lightness(136) - lightness(119), 0.7);
  ASSERT_LT(difference, knee);
  EXPECT_NEAR(flip(uniform({119, 119, 119}), uniform({136, 136, 136})), 0.95 * difference / knee,
              kTableWhite);
}

TEST(Flip, OfUniformColoursAgreesWithTheAuthorsProgram) {
  EXPECT_NEAR(flip(uniform({0, 0, 0}), uniform({255, 255, 255})), 0.9673951, kSinglePrecisionUniform);
  EXPECT_NEAR(flip(uniform({255, 0, 0}), uniform({0, 255, 0})), 0.9866790, kSinglePrecisionUniform);
  EXPECT_NEAR(flip(uniform({0, 255, 0}), uniform({0, 0, 255})), 1, 1e-12);  // the largest, by definition
  EXPECT_NEAR(flip(uniform({200, 100, 50}), uniform({190, 110, 60})), 0.1978257, kSinglePrecisionUniform);
  EXPECT_NEAR(flip(uniform({128, 128, 128}), uniform({136, 136, 136})), 0.1275922, kSinglePrecisionUniform);
}

TEST(Flip, OfWholePicturesAgreesWithTheAuthorsProgram) {
  EXPECT_NEAR(flip(test::texture(), test::noisy_texture()), 0.0395135, kSinglePrecision);
  EXPECT_NEAR(flip(test::texture(), test::moved_texture()), 0.2805232, kSinglePrecision);
  EXPECT_NEAR(flip(test::first_shapes(), test::second_shapes()), 0.0255685, kSinglePrecision);
}

TEST(Flip, AtOtherDistancesAgreesWithTheAuthorsProgram) {
  EXPECT_NEAR(flip(test::texture(), test::noisy_texture(), 20), 0.1903533, kSinglePrecision);
  EXPECT_NEAR(flip(test::first_shapes(), test::second_shapes(), 20), 0.0221111, kSinglePrecision);
  EXPECT_NEAR(flip(test::texture(), test::noisy_texture(), 134), 0.0257442, kSinglePrecision);
  EXPECT_NEAR(flip(test::first_shapes(), test::second_shapes(), 134), 0.0279989, kSinglePrecision);
}

// The places are on the lone pixel, the rectangle's left border, its other border, and inside.
TEST(Flip, OfSinglePixelsAgreesWithTheAuthorsProgram) {
  const Plane map = flip_map(test::first_shapes(), test::second_shapes());
  constexpr double kPixel = 3e-5;  // means are closer
  EXPECT_NEAR(map.row(50)[80], 0.4089729, kPixel);
  EXPECT_NEAR(map.row(30)[30], 0.3631995, kPixel);
  EXPECT_NEAR(map.row(20)[60], 0.1703194, kPixel);
  EXPECT_NEAR(map.row(30)[45], 0.1496604, kPixel);
  EXPECT_EQ(map.row(63)[95], 0);
}

// A board of single black and white pixels is grey from afar; 188 has half the light of white, as nearly as 8
// bits can: 0.003 more, which FLIP finds to be 0.03.
TEST(Flip, FindsWhatTheEyeCannotResolveNoDifference) {
  const Image board = test::drawn(96, 64, [](int x, int y) {
    const int v = (x + y) % 2 ? 255 : 0;
    return std::array<int, 3>{v, v, v};
  });
  const Image grey(96, 64, Rgb8{188, 188, 188});
  EXPECT_LT(flip(board, grey, 200), 0.05);
  EXPECT_GT(flip(board, grey, 10), 0.5);
}

TEST(FlipHeatMap, RunsFromNoneToAllOnTheSequentialMap) {
  Plane errors(3, 1);
  errors.values = {0, 1, 2};
  const Image heat = heat_map(errors);
  const Rgb8 none = map_color8(ColorMap::sequential, 0), all = map_color8(ColorMap::sequential, 1);
  EXPECT_TRUE(std::equal(none.begin(), none.end(), heat.at(0, 0)));
  EXPECT_TRUE(std::equal(all.begin(), all.end(), heat.at(1, 0)));
  EXPECT_TRUE(std::equal(all.begin(), all.end(), heat.at(2, 0)));
}

}  // namespace
}  // namespace hysteron::render
