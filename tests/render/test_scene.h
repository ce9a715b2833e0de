// Small things that the render tests share: a folded cloth on a pedestal, folders, plots, pixels.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <vector>

#include "render/cloth_view.h"
#include "sim/base/process.h"
#include "tests/sim/base/folder.h"
#include "tests/sim/base/refusal.h"

namespace hysteron::render {

using hysteron::test::file_content;
using hysteron::test::Folder;  // removed with its content
using hysteron::test::says;
using hysteron::test::thrown_error;

namespace test {

struct Cloth {
  std::vector<float> positions, pattern, values;
  std::vector<int> triangles;

  ClothTopology topology() const { return {positions.size() / 3, triangles, pattern}; }
};

// Returns a flat square of 2 * cells^2 triangles with its front up, `side` wide, at height z [m]; no pattern,
// values 0.
Cloth flat_square(int cells, float side, float z);
// Disc draped over a pedestal of 45 mm radius and 120 mm height with six analytic folds: 2 * rings * sectors
// triangles.
Cloth draped_disc(int rings, int sectors);

// Returns a view of the draped disc on its pedestal on the ground, ready to draw.
std::unique_ptr<ClothView> draped_view(Offscreen& offscreen, const PictureSize& size, const Look& look);
Camera draped_camera(float aspect);

// Draws such a picture of this look.
Image draped_picture(Offscreen& offscreen, const PictureSize& size, const Look& look);

// A view of a cloth that lies free, ready to draw.
std::unique_ptr<ClothView> cloth_view(Offscreen& offscreen, const PictureSize& size, const Cloth& cloth,
                                      const Look& look);

// Returns the mean of the channels over a square of pixels around (x, y).
double brightness(const Image& image, int x, int y, int half_side = 2);

// How many pixels are such, those between left and right, top and bottom: all of the picture, if not said.
template <class Such>
int count_pixels(const Image& image, const Such& such, int left = 0, int top = 0, int right = 1 << 20,
                 int bottom = 1 << 20) {
  int count = 0;
  for (int y = top; y < std::min(bottom, image.height()); ++y)
    for (int x = left; x < std::min(right, image.width()); ++x) count += such(image.at(x, y));
  return count;
}

// Tests that draw.
class OffscreenTest : public testing::Test {
 protected:
  std::unique_ptr<Offscreen> offscreen_ = Offscreen::create(Renderer::automatic);
};

// Tests that need gnuplot, with a folder.
class GnuplotTest : public testing::Test {
 protected:
  void SetUp() override {
    if (run_process({"gnuplot", "--version"}, "").exit_code != 0)
      GTEST_SKIP() << "gnuplot is not installed (gnuplot-nox)";
  }
  Folder folder_;
};

}  // namespace test
}  // namespace hysteron::render
