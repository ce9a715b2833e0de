#include "render/lit_pixels.h"

#include "render/flip.h"
#include "render/offscreen.h"
#include "tests/render/test_scene.h"

namespace hysteron::render {
namespace {

using Pixels = std::vector<float>;

// Returns columns of light, RGBA each, in two rows.
Pixels two_rows(const std::vector<float>& columns) {
  Pixels rgba;
  for (int row = 0; row < 2; ++row)
    for (const float light : columns) rgba.insert(rgba.end(), {light, light, light, 1});
  return rgba;
}

TEST(LitPixels, FurtherPassesCountWhereTheFirstDiffersFromANeighbour) {
  const auto offscreen = Offscreen::create(Renderer::automatic);
  LitPixels lit(offscreen->gl(), 6, 2);
  lit.take_first(two_rows({0.2f, 0.2f, 0.205f, 0.5f, 0.5f, 0.5f}));
  EXPECT_EQ(lit.uneven_area().left, 2);
  EXPECT_EQ(lit.uneven_area().width, 2);
  EXPECT_EQ(lit.uneven_area().height, 2);
  Pixels further = two_rows({0.9f, 0.9f, 0.9f, 0.9f, 0.9f, 0.9f});
  lit.complete(further);
  EXPECT_EQ(further, two_rows({0.2f, 0.2f, 0.9f, 0.9f, 0.5f, 0.5f}));
}

// A picture that is lit where it has to be is hardly further from one of 128 samples a pixel (FLIP of 0.0131)
// than one that is lit all over (0.0127).
TEST(LitPixels, ArePixelsEnough) {
  constexpr int kSide = 240;
  const auto offscreen = Offscreen::create(Renderer::automatic);
  const auto drawn = [&](int supersample) {
    return test::draped_picture(*offscreen, {.width = kSide, .height = kSide, .supersample = supersample},
                                look_named("clay"));
  };
  EXPECT_LT(flip(drawn(1), drawn(4)), 0.015);
}

}  // namespace
}  // namespace hysteron::render
