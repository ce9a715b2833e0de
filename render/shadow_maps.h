// Maps of what hides the light: one for the key light, drawn sharp, and one small map for each of a few
// directions of the sky.  The sky's are looked up per vertex, on the ground per texel, and averaged: ambient
// occlusion by the bodies in the way, the same on every driver, for the price of depth-only passes.
#pragma once

#include <Eigen/Core>
#include <array>
#include <functional>

#include "render/camera.h"
#include "render/gl/handles.h"
#include "render/gl/program.h"

namespace hysteron::render {

// Textures of depth as a light sees it, and the framebuffers that draw them.

// Returns a texture that is bound, interpolates between four texels and repeats its border outside; `stored`
// is the format of a texel, `channels` its components.
GlTexture filtered_texture(const GlFunctions& gl, GLint stored, GLenum channels, int width, int height);
// Returns a depth map of this size [texels] whose lookups compare, interpolate between four texels and repeat
// its border outside.
GlTexture depth_map(const GlFunctions& gl, int width, int height);
// Returns a framebuffer that draws depth alone into the map.
GlFramebuffer depth_target(const GlFunctions& gl, const GlTexture& map);

inline constexpr int kSkyLights = 24;

class ShadowMaps {
 public:
  explicit ShadowMaps(const GlFunctions& gl);

  // `casters` is the box of everything that throws a shadow, `to_light` the direction to the key light,
  // `room` the brightness of the room (Look).
  void aim(const Box& casters, const Eigen::Vector3f& to_light, float room);
  // Draws all maps; `draw_casters` draws with the depth program in use, setting "model", "keep"
  // and "inset".
  void draw(const std::function<void(const Program&)>& draw_casters) const;
  // Gives the program in use the maps and the parameters of lookups: `sky_blur` is the radius of a lookup in
  // the sky maps, `sky_lift` the height above the surface from which they are asked, both in their texels.
  void bind(const Program& program, float sky_blur = 1.6f, float sky_lift = 1.2f) const;
  const Eigen::Vector3f& to_light() const { return to_light_; }

 private:
  const GlFunctions* gl_;
  Program depth_program_;
  GlTexture key_map_, sky_map_;
  GlSampler depth_sampler_;  // reads the key map's depths instead of comparing with them
  GlFramebuffer key_target_, sky_target_;
  std::array<Eigen::Vector3f, kSkyLights> sky_directions_;
  std::array<Eigen::Matrix4f, kSkyLights> sky_matrices_;
  Eigen::Matrix4f key_matrix_;
  Eigen::Vector3f to_light_{0, 0, 1};
  float room_ = 1;
  float radius_ = 1;  // radius of the casters' box [m]
};

}  // namespace hysteron::render
