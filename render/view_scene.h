// The scene that the passes of a picture draw: the cloth, obstacles and the ground, in a look.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "render/camera.h"
#include "render/drawn_cloth.h"
#include "render/ground.h"
#include "render/look.h"
#include "render/obstacles.h"

namespace hysteron::render {

struct ViewScene {
  ViewScene(const GlFunctions& gl, bool figure) : is_figure(figure), obstacles(gl) {}

  const bool is_figure;
  std::optional<DrawnCloth> cloth;
  Obstacles obstacles;
  std::optional<float> ground_height;  // [m]; none: no ground
  std::optional<Ground> ground;        // there if there is a height
  std::optional<Box> given_bounds;     // of all that casts a shadow in the whole sequence
  Look look;

  bool is_silhouette() const { return look.show == Show::silhouette; }
  bool is_transparent() const { return look.background == Background::transparent && !is_silhouette(); }
  // Returns the box of all that casts a shadow [m].
  Box bounds() const;
  // Returns the height at which the ground is drawn [m].
  float pictured_ground() const;
  // Returns the direction to the key light, of any length.
  Eigen::Vector3f to_light(const Camera& camera) const;
  ObstacleFit fit() const { return {cloth ? cloth->side() : 0, look.obstacle_inset, ground_height}; }
  // Draws all that casts a shadow with the depth program in use.
  void draw_casters(const Program& program) const;
};

}  // namespace hysteron::render
