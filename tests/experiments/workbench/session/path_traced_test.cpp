// A figure beside a path tracer's picture of the scene that is exported for it: the same light.
//
// path_traced.png is that picture.  HYSTERON_PATH_TRACED=DIR makes the test write the scene into DIR, from
// which
//   import mitsuba as mi; mi.set_variant("scalar_rgb")
//   mi.util.write_bitmap("path_traced.png", mi.render(mi.load_file("DIR/scene.xml", spp=1024))[:, :, :3])
// draws it anew (Mitsuba 3.9).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>

#include "experiments/workbench/pictures/drawing.h"
#include "experiments/workbench/pictures/scene_renderer.h"
#include "experiments/workbench/session/mitsuba_scene.h"
#include "render/flip.h"
#include "render/inset.h"
#include "sim/base/atomic_file.h"
#include "sim/mesh/cloth_mesh.h"
#include "sim/scene/scene_reader.h"

namespace hysteron::experiments {
namespace {

constexpr int kCells = 40;          // of the cloth along a side
constexpr float kLength = 0.22f;    // [m]
constexpr double kBallLift = 5e-3;  // of the ball over the ground [m]

class ClothBesideABall {
 public:
  ClothBesideABall() {
    setup_.options.size = "320x180";
    setup_.options.quality = PictureQuality::figure;
    setup_.options.look = "clay";
    setup_.options.camera_box = {-0.1, -0.1, 0, 0.07, 0.08, 0.085};
    Obstacle ball, ground;
    ball.kind = ObstacleKind::sphere;
    ball.radius = 0.028;
    ball.center = {-0.1, -0.09, ball.radius + kBallLift};
    ground.kind = ObstacleKind::ground;
    setup_.scene.obstacle = {ball, ground};
    for (const Eigen::Vector3d& p : mesh_.rest) positions_.push_back(bulging(p));
    view_ = picture_view(setup_, render::bounding_box(flat_points(positions_)), {});
    view_.look.front = view_.look.back = {128, 140, 156};  // darker than what a figure's tone bends
  }

  render::Image figure() const { return figure(view_.look); }

  void write(const std::filesystem::path& folder) const {
    const float side = render::long_side(flat_triangles(mesh_.face), flat_points(positions_), 3);
    write_body((folder / "ball.ply").string(), *obstacle_mesh(setup_.scene.obstacle[0]), view_.look, side);
    write_ply((folder / "cloth.ply").string(), mesh_, positions_, {});
    write_text((folder / "scene.xml").string(),
               mitsuba_scene(view_, setup_.scene, 0, "cloth.ply", {"ball.ply", ""}));
  }

  // Returns which pixels show cloth or ball alone: it draws them again in red without a trace of the page.
  std::vector<bool> bodies() const {
    render::Look red = view_.look;
    red.front = red.back = red.obstacle = {120, 0, 0};
    const render::Image marked = figure(red);
    std::vector<bool> result;
    for (int y = 0; y < marked.height(); ++y)
      for (int x = 0; x < marked.width(); ++x) result.push_back(marked.at(x, y)[2] == 0);
    return result;
  }

 private:
  render::Image figure(const render::Look& look) const {
    const DrawnMesh drawn{mesh_.rest.size(), flat_triangles(mesh_.face), {}};
    SceneRenderer renderer(setup_.scene, setup_.options, drawn, view_.bounds, view_.floor, -1);
    renderer.view().set_positions(flat_points(positions_));
    return renderer.draw(look, view_.camera, {});
  }

  // Cloth that bulges and falls to the ground in folds.
  static Eigen::Vector3d bulging(const Eigen::Vector3d& p) {
    const double x = p.x() - kLength / 2, y = p.y() - kLength / 2, r = std::hypot(x, y) / kLength;
    const double fold = 0.05 * r * r * std::cos(4 * std::atan2(y, x));
    return {0.85 * x, 0.85 * y, 0.03 + 0.085 * std::exp(-7 * r * r) + fold};
  }

  Setup setup_{default_scene(), {}};
  ClothMesh mesh_ = make_grid(kLength, kLength, kCells, kCells, MeshFamily::aligned, 1);
  std::vector<Eigen::Vector3d> positions_;
  PictureView view_;
};

void whiten(render::Image& image, const std::vector<bool>& kept) {
  for (std::size_t i = 0; i < kept.size(); ++i)
    if (!kept[i]) std::fill_n(image.pixels().begin() + static_cast<std::ptrdiff_t>(3 * i), 3, 255);
}

// Where both show the same: the page is white by taste, the path tracer's ground as grey as the floor whose
// light the cloth gets.
TEST(PathTraced, AFigureShowsTheSameLightOnClothAndBodies) {
  const ClothBesideABall scene;
  if (const char* folder = std::getenv("HYSTERON_PATH_TRACED")) scene.write(folder);
  const std::vector<bool> shown = scene.bodies();
  const auto count = static_cast<double>(std::count(shown.begin(), shown.end(), true));
  ASSERT_GT(count, 0.15 * static_cast<double>(shown.size()));
  render::Image drawn = scene.figure(), traced = render::read_png(HYSTERON_PATH_TRACED_PICTURE);
  whiten(drawn, shown);
  whiten(traced, shown);
  const double whole = render::flip(drawn, traced), share = count / static_cast<double>(shown.size());
  RecordProperty("flip", std::to_string(whole));
  // Measured: 0.0145, and 0.063 over cloth and ball alone.  The floor of a figure is lit as if nothing stood
  // on it, so that sides turned to its shadow are 5 to 8 % brighter (0.5 to 4 % against an unshaded floor);
  // else they differ by 2 %.
  constexpr double kMost = 0.02, kMostOnBodies = 0.07;
  EXPECT_LE(whole, kMost);
  EXPECT_LE(whole / share, kMostOnBodies);
}

}  // namespace
}  // namespace hysteron::experiments
