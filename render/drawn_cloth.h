// The cloth of a picture: its surface on the GPU, and what is known here of its positions.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "render/camera.h"
#include "render/cloth_surface.h"
#include "sim/device/gl_positions.h"

namespace hysteron::render {

class DrawnCloth {
 public:
  DrawnCloth(const GlFunctions& gl, const ClothTopology& topology);

  ClothSurface& surface() { return surface_; }
  const ClothSurface& surface() const { return surface_; }

  bool has(std::span<const float> xyz) const;  // true if these are the present positions
  // Takes x, y, z of each vertex [m].
  void set_positions(std::span<const float> xyz);
  // Takes the box of the present positions; Error::invalid_input if one is not finite.
  void measure_box();
  // The box of the positions [m], if it was taken.
  const std::optional<Box>& box() const { return box_; }
  // Returns the unit normal of the plane that lies nearest to the positions, if they are known.
  std::optional<Eigen::Vector3f> normal() const;
  // Takes the writer of the surface's position buffer, or null for none, in place of an earlier one.
  void share_positions(std::unique_ptr<GlPositions> positions) { shared_positions_ = std::move(positions); }
  bool shares_positions() const { return shared_positions_ != nullptr; }
  // Makes the shared writer write the present positions.  Returns false if writing failed, which ends sharing
  // and sets `reason`.
  bool write_positions(std::string& reason);

  // The side of the triangles at the first positions [m]; until then that of the pattern, 0 without one.
  float side() const { return side_; }
  bool knows_side() const { return triangles_.empty(); }
  void set_side(float side);

 private:
  ClothSurface surface_;
  std::unique_ptr<GlPositions> shared_positions_;  // declared below the surface, to be closed first
  std::vector<float> positions_;                   // empty unless they were given; a writer's stay on the GPU
  std::optional<Box> box_;
  std::vector<int> triangles_;  // kept until positions tell their side
  float side_;
};

// Sets the placement of the cloth, which is drawn as it is, in the program in use.
void place_cloth(const Program& program);

}  // namespace hysteron::render
