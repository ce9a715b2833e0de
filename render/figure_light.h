// The light of a figure: many directions of a key light, of the sky and of the floor, each with a depth map
// of its casters.  A figure is drawn in several passes, and each pass is lit from a few directions of its
// own, so that every pixel averages all of them: soft shadows and ambient light without noise, the same on
// every driver.
#pragma once

#include <Eigen/Core>
#include <array>
#include <functional>
#include <vector>

#include "render/camera.h"
#include "render/gl/handles.h"
#include "render/gl/program.h"

namespace hysteron::render {

// Numbers of directions in one pass, as in figure_light.glsl.
inline constexpr int kPassKeys = 4, kPassSkies = 6, kPassFloors = 2;
inline constexpr int kPassLights = kPassKeys + kPassSkies + kPassFloors;

// The light of a figure for a path tracer: that of the key light, a disc, on a surface that faces it, of the
// sky on one that faces up, and of the floor, a grey table without shadows, on one that faces down.
struct StudioLight {
  Eigen::Vector3f key, sky, floor;
  float key_radius;  // radius of the key light over its distance
  float exposure;    // the brightness of a white surface over the light on it
};
// `room` is the brightness of sky and floor (Look).
StudioLight studio_light(float room);

class FigureLight {
 public:
  // `passes` is the picture's number of passes; 16 of them have 64 directions of the key, 96 of the sky, 32
  // of the floor.
  FigureLight(const GlFunctions& gl, int passes);

  int passes() const { return passes_; }
  // `casters` is the box of everything that throws a shadow, `to_light` the direction to the middle of the
  // key light, `room` the brightness of sky and floor (Look).
  void aim(const Box& casters, const Eigen::Vector3f& to_light, float room);
  // Draws the maps of one pass; `draw_casters` draws with the depth program in use, setting "model", "keep"
  // and "inset".
  void draw(int pass, const std::function<void(const Program&)>& draw_casters);
  // Gives the program in use the maps and light of the pass drawn last.
  void bind(const Program& program) const;

 private:
  struct Direction {
    Eigen::Vector3f to_light;
    Eigen::Vector3f weight;  // light on a surface that faces it
  };
  Direction direction(int pass, int light) const;

  const GlFunctions* gl_;
  int passes_;
  Program depth_program_;
  GlTexture key_map_, room_map_;
  GlFramebuffer key_target_, room_target_;
  Box casters_{{-1, -1, -1}, {1, 1, 1}};
  Eigen::Vector3f to_light_{0, 0, 1}, open_{1, 1, 1};
  float room_ = 1;
  std::array<Direction, kPassLights> directions_;
  std::array<Eigen::Matrix4f, kPassLights> matrices_;
  std::array<float, kPassLights> texels_{};  // size of a map's texel [m]
};

}  // namespace hysteron::render
