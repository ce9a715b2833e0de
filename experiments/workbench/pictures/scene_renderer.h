// Draws a scene: the cloth at one instant, its obstacles, ground, light and camera.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "experiments/workbench/app/options.h"
#include "experiments/workbench/pictures/archived_geometry.h"
#include "render/camera.h"
#include "render/caption.h"
#include "render/cloth_view.h"
#include "render/shapes.h"
#include "sim/scene/scene.h"

namespace hysteron::experiments {

// Returns an obstacle's surface before it is placed; nothing if it is drawn otherwise, or not at all.  The
// surface of a body of triangles is that at `time` [s], rounded to multiples of `quantum` [m] (drawn_body.h).
std::optional<render::TriangleMesh> obstacle_mesh(const Obstacle& obstacle,
                                                  const render::ShapeDetail& detail = render::kSeen,
                                                  double time = 0, double quantum = 0);
// Returns its placement at `time` [s].
Eigen::Matrix4f placed_at(const Obstacle& obstacle, double time);

// Returns the colours of a look that shows a value.
render::ColorMap look_color_map(const std::string& look);
// Returns light, and the ends of the colour map, of the options' look `name` ("cloth", "curvature",
// "residual", "difference", ...) for a scene.
render::Look scene_look(const Scene& scene, const Options& options, const std::string& name);
// Returns the colour bar of looks that show a value.
std::optional<render::ColorBar> value_color_bar(const Scene& scene, const Options& options,
                                                const std::string& name);

// All of it belongs to the thread that made it, as its OpenGL context does.
class SceneRenderer {
 public:
  // `bounds` contain what casts shadows in the whole sequence [m]; `floor` is the height of the visible
  // ground [m]; `cuda_device` is tried first, -1: none.
  SceneRenderer(const Scene& scene, const Options& options, const DrawnMesh& mesh, const render::Box& bounds,
                std::optional<float> floor, int cuda_device);

  const render::Offscreen& offscreen() const { return *offscreen_; }
  render::ClothView& view() { return *view_; }  // for setting the cloth's positions
  // Changes the size of the next pictures.  Positions have to be set anew.
  void take_size(const render::PictureSize& size);

  // The state that a picture shows beside positions.
  struct Shown {
    double time = 0;            // time of the obstacles [s]
    std::vector<float> values;  // one per vertex, in looks that show a value
  };
  render::Image draw(const render::Look& look, const render::Camera& camera, const Shown& shown);
  // Does the same, but obstacles that hide much of what is behind them are translucent.
  render::Image draw_with_ghosts(const render::Look& look, const render::Camera& camera, const Shown& shown);
  // Draws the cloth alone from straight above, black on white; `xyz` has 3 numbers a vertex [m].  Positions
  // have to be set anew.
  render::Image silhouette(const std::vector<float>& xyz, const render::Camera& camera, int pixels);

 private:
  void place_obstacles(double time, bool visible);
  // Returns the surface of a body of triangles, as pictures show it at `time` [s].
  std::optional<render::TriangleMesh> surface_of(const Obstacle& obstacle, const render::ShapeDetail& detail,
                                                 double time) const;

  const DrawnMesh& mesh_;
  render::Box bounds_;
  std::optional<float> floor_;
  std::vector<Obstacle> scenery_;
  std::unique_ptr<render::Offscreen> offscreen_;
  std::unique_ptr<render::ClothView> view_;
  render::PictureSize size_;
  std::vector<int> body_;  // by obstacle: its index in the view, -1 = not a body
  double shaped_at_ = 0;   // time of the current shapes of bodies that change them [s]
};

}  // namespace hysteron::experiments
