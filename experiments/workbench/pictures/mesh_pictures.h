// Draws pictures of surfaces from files in the way of runs.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "experiments/workbench/pictures/drawing.h"
#include "render/cloth_view.h"
#include "sim/mesh/surface.h"

namespace hysteron::experiments {

class MeshPictures {
 public:
  struct Choice {
    render::Box bounds;             // box framed in every picture [m]
    std::optional<float> ground;    // height of a visible ground [m]
    double range = 100;             // curvature at the ends of the colour bar [1/m]
    bool stored_curvature = false;  // shows the frames' own curvature, without computing it
    std::string fabric;             // fabric whose look the cloth has; empty: the program's default
  };
  // Uses these options: size, renderer, look ("cloth", "curvature", "wireframe" or "silhouette"), light,
  // camera.
  MeshPictures(const Options& options, const Choice& choice);

  const std::string& renderer() const { return offscreen_->description(); }
  // Adds a body that every picture shows as an obstacle [m].
  void add_body(const Surface& body);
  // Begins frames of another cloth.
  void begin_sequence() { face_.clear(); }
  // Draws `frame` [m], still without text; `what` names it in messages.  Threads follow the first frame with
  // these triangles.  A frame must have the curvature that is to be shown as stored.  Throws
  // Error::invalid_input if curvature is to be computed and the triangles allow none (surface_curvature),
  // Error::simulation if the picture shows nothing of it.
  render::Image picture(const Surface& frame, const std::string& what);
  // Adds caption, scale and colour bar.
  void letter_picture(render::Image& image, const std::string& caption) const;
  // Sets the direction to the eye for the next pictures.
  void look_from(const Eigen::Vector3d& direction) { options_.camera_direction = direction; }
  render::Camera camera() const { return framed_camera(options_, choice_.bounds); }
  double metres_per_pixel() const;
  std::optional<render::ColorBar> color_bar() const;  // for looks that show a value
  // Returns the root mean square over the vertices of the last picture [1/m]; nothing in other looks than
  // "curvature".
  std::optional<double> curvature_rms() const;

 private:
  Options options_;
  Choice choice_;
  render::Look look_;
  std::unique_ptr<render::Offscreen> offscreen_;
  render::ClothView view_;
  // Triangles of the view's cloth; empty before the first of this sequence.
  std::vector<Eigen::Vector3i> face_;
  std::size_t vertices_ = 0;
  std::vector<float> curvature_;  // by vertex [1/m]
  std::vector<double> area_;      // by vertex [m^2]
};

}  // namespace hysteron::experiments
