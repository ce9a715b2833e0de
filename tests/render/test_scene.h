// Small things that the render tests share: a folded cloth on a pedestal, folders, expected errors.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "render/cloth_view.h"
#include "sim/base/error.h"
#include "tests/sim/base/folder.h"

namespace hysteron::render::test {

struct Cloth {
  std::vector<float> positions, pattern, values;
  std::vector<int> triangles;

  ClothTopology topology() const { return {positions.size() / 3, triangles, pattern}; }
};

// Flat square of 2 * cells^2 triangles with its front up, `side` wide, at height z [m]; no pattern, values 0.
Cloth flat_square(int cells, float side, float z);
// Disc draped over a pedestal of 45 mm radius and 120 mm height with six analytic folds: 2 * rings * sectors
// triangles.
Cloth draped_disc(int rings, int sectors);

// A view of the draped disc on its pedestal on the ground, ready to draw.
std::unique_ptr<ClothView> draped_view(Offscreen& offscreen, const PictureSize& size, const Look& look);
Camera draped_camera(float aspect);

using hysteron::test::file_content;
using hysteron::test::Folder;  // removed with its content

// The hysteron::Error that `action` throws; a test failure and a run error "nothing was thrown" otherwise.
Error thrown_error(const std::function<void()>& action);

// Mean of the channels over a square of pixels around (x, y).
double brightness(const Image& image, int x, int y, int half_side = 2);

}  // namespace hysteron::render::test
