// The ground under a scene: a patch of the backdrop's paper that carries the scene's shadow.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "render/camera.h"
#include "render/gl/handles.h"
#include "render/gl/program.h"
#include "render/shadow_maps.h"
#include "render/static_mesh.h"

namespace hysteron::render {

class Ground {
 public:
  // A `figure` ground is lit per pixel by the light of a figure (figure_light.h), another by a texture that
  // lies on it.
  Ground(const GlFunctions& gl, bool figure);

  // Sets whether the shadow is a layer without a backdrop; must be called before drawing.
  void be_layer(bool layer);
  // Places a figure's ground below and around `box`, at `height` [m].
  void place(const Box& box, float height);

  // Computes the light on the ground at `height` [m] under casters in `box`; the shadow maps must be up to
  // date.
  void update(const ShadowMaps& shadows, const Box& box, float height);
  // Puts the patch's program in use and returns it; the caller sets the camera and the backdrop.
  const Program& begin() const;
  void draw() const;

 private:
  // Draws the program in use over the whole of a texture, `side` texels wide.
  void fill(const Program& program, const GlFramebuffer& target, int side) const;

  const GlFunctions* gl_;
  bool is_figure_, is_layer_ = false;
  Program sky_program_, light_program_;
  std::optional<Program> program_;
  StaticMesh mesh_;
  GlVertexArray no_arrays_;
  GlTexture sky_, light_;
  GlFramebuffer sky_target_, light_target_;
  Eigen::Matrix4f placement_;
};

}  // namespace hysteron::render
