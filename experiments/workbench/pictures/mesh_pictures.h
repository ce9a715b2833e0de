// Pictures of surfaces from files, as runs are pictured.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "experiments/workbench/pictures/drawing.h"
#include "sim/mesh/surface.h"

namespace hysteron::experiments {

class MeshPictures {
 public:
  struct Choice {
    render::Box bounds;             // framed in every picture [m]
    std::optional<float> ground;    // height of a visible ground [m]
    double range = 100;             // of curvature, at the ends of the colour bar [1/m]
    bool stored_curvature = false;  // shown as the frames have it, not computed
    std::string fabric;             // whose look the cloth has; empty: the program's
  };
  // Of the options: size, renderer, look ("cloth", "curvature", "wireframe" or "silhouette"), light, camera.
  MeshPictures(const Options& options, const Choice& choice);

  const std::string& renderer() const { return offscreen_->description(); }
  // What is drawn in every picture as obstacles are [m].
  void add_body(const Surface& body);
  // The frames to come belong to another cloth.
  void begin_sequence() { face_.clear(); }
  // `frame` [m], still without letters; `what` names it in messages.  Threads follow the first frame that has
  // these triangles.  A frame whose curvature is to be shown as stored has it.  Throws Error::invalid_input
  // where curvature is to be computed and the triangles allow none (surface_curvature), Error::simulation
  // where the picture shows nothing of it.
  render::Image picture(const Surface& frame, const std::string& what);
  // Caption, scale and colour bar.
  void letter_picture(render::Image& image, const std::string& caption) const;
  // Pictures to come are seen from there; it points to the eye.
  void look_from(const Eigen::Vector3d& direction) { options_.camera_direction = direction; }
  render::Camera camera() const { return framed_camera(options_, choice_.bounds); }
  double metres_per_pixel() const;
  std::optional<render::ColorBar> color_bar() const;  // of looks that show a value
  // Root of the mean square over the vertices last pictured [1/m]; nothing in other looks than "curvature".
  std::optional<double> curvature_rms() const;

 private:
  Options options_;
  Choice choice_;
  render::Look look_;
  std::unique_ptr<render::Offscreen> offscreen_;
  render::ClothView view_;
  std::vector<Eigen::Vector3i> face_;  // of the cloth that the view has; empty: none of this sequence
  std::size_t vertices_ = 0;
  std::vector<float> curvature_;  // of each vertex [1/m]
  std::vector<double> area_;      // likewise [m^2]
};

}  // namespace hysteron::experiments
