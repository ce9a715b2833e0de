#include "tests/render/test_scene.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace hysteron::render::test {
namespace {

constexpr float kPedestalRadius = 0.045f, kPedestalHeight = 0.12f;

// Returns a point of the drape's meridian: flat on the pedestal, then bending down, less so on the six
// ridges.
Eigen::Vector3f draped_point(float distance, float angle) {
  const float gap = 0.0003f;
  float r = std::min(distance, kPedestalRadius), z = kPedestalHeight + gap;
  constexpr int kSteps = 40;
  const float overhang = std::max(0.0f, distance - kPedestalRadius), step = overhang / kSteps;
  for (int k = 0; k < kSteps; ++k) {
    const float q = (k + 0.5f) * step / 0.105f;
    const float down = 1.45f * (1 - std::exp(-6 * q)) - 0.75f * std::cos(6 * angle) * (1 - std::exp(-3 * q));
    r += step * std::cos(std::max(down, 0.0f));
    z -= step * std::sin(std::max(down, 0.0f));
  }
  return {r * std::cos(angle), r * std::sin(angle), z};
}

}  // namespace

Cloth flat_square(int cells, float side, float z) {
  Cloth cloth;
  const int n = cells + 1;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const float x = side * (static_cast<float>(i) / cells - 0.5f),
                  y = side * (static_cast<float>(j) / cells - 0.5f);
      cloth.positions.insert(cloth.positions.end(), {x, y, z});
      cloth.values.push_back(0);
    }
  for (int i = 0; i < cells; ++i)
    for (int j = 0; j < cells; ++j) {
      const int a = i * n + j, b = a + n;
      cloth.triangles.insert(cloth.triangles.end(), {a, b, b + 1, a, b + 1, a + 1});
    }
  return cloth;
}

Cloth draped_disc(int rings, int sectors) {
  Cloth cloth;
  constexpr float kRadius = 0.15f;
  for (int i = 0; i <= rings; ++i)
    for (int j = 0; j < sectors; ++j) {
      const float s = kRadius * (static_cast<float>(i) + 0.02f) / (static_cast<float>(rings) + 0.02f);
      const float angle = 2 * std::numbers::pi_v<float> * static_cast<float>(j) / static_cast<float>(sectors);
      const Eigen::Vector3f p = draped_point(s, angle);
      cloth.positions.insert(cloth.positions.end(), {p.x(), p.y(), p.z()});
      cloth.pattern.insert(cloth.pattern.end(), {s * std::cos(angle), s * std::sin(angle)});
      cloth.values.push_back(std::sin(6 * angle) * std::max(0.0f, s / kRadius - 0.3f));
    }
  for (int i = 0; i < rings; ++i)
    for (int j = 0; j < sectors; ++j) {
      const int a = i * sectors + j, b = i * sectors + (j + 1) % sectors, c = a + sectors, d = b + sectors;
      cloth.triangles.insert(cloth.triangles.end(), {a, c, b, b, c, d});
    }
  return cloth;
}

std::unique_ptr<ClothView> draped_view(Offscreen& offscreen, const PictureSize& size, const Look& look) {
  const Cloth cloth = draped_disc(40, 120);
  auto view = std::make_unique<ClothView>(offscreen, size);
  view->set_cloth(cloth.topology());
  view->set_positions(cloth.positions);
  view->set_values(cloth.values);
  view->add_obstacle(cylinder_mesh(kPedestalRadius, kPedestalHeight, 0.002f),
                     placed({0, 0, kPedestalHeight / 2}, {0, 0, 1}));
  view->set_ground(0.0f);
  view->set_look(look);
  return view;
}

Camera draped_camera(float aspect) {
  return Camera::framing({{-0.13f, -0.13f, 0}, {0.13f, 0.13f, 0.12f}}, {0.35f, -1, 0.5f}, 24, aspect);
}

Image draped_picture(Offscreen& offscreen, const PictureSize& size, const Look& look) {
  const float aspect = static_cast<float>(size.width) / static_cast<float>(size.height);
  return draped_view(offscreen, size, look)->draw(draped_camera(aspect));
}

std::unique_ptr<ClothView> cloth_view(Offscreen& offscreen, const PictureSize& size, const Cloth& cloth,
                                      const Look& look) {
  auto view = std::make_unique<ClothView>(offscreen, size);
  view->set_look(look);
  view->set_cloth(cloth.topology());
  view->set_positions(cloth.positions);
  return view;
}

double brightness(const Image& image, int x, int y, int half_side) {
  double sum = 0;
  for (int j = y - half_side; j <= y + half_side; ++j)
    for (int i = x - half_side; i <= x + half_side; ++i)
      sum += image.at(i, j)[0] + image.at(i, j)[1] + image.at(i, j)[2];
  return sum / (3.0 * (2 * half_side + 1) * (2 * half_side + 1));
}

}  // namespace hysteron::render::test
