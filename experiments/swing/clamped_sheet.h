// The sheet of the swing experiment: the places of its clamp and free end, and its direction of swing.
#pragma once

#include <vector>

#include "render/camera.h"
#include "sim/scene/cloth.h"

namespace hysteron::experiments {

inline constexpr double kClampedLength = 0.01;  // clamped length [m]; the rest of the sheet swings

// True if the sheet is a rectangle from x = 0 on, as cloth.shape makes it.
bool is_flat_rectangle(const Scene& scene);

struct SheetPlacement {
  double length = 0, width = 0;  // lengths at rest along x and across [m]
  int clamp = 0, tip = 0;        // indices of a held vertex and of the free end's middle
  Eigen::Vector3d corner;  // initial corner of the clamped end and the low side, or the pins' middle [m]
  Eigen::Vector3d along;   // horizontal direction in the plane of the swing
  Eigen::Vector3d across;  // direction of the width, or of the line of pins
  Eigen::Vector3d up;      // direction against gravity
  double reach = 0;        // farthest distance from the middle of the scene's pins [m]; 0 for a clamp

  // Returns the free end's coordinate along the swing's direction [m].
  double swing(const std::vector<Eigen::Vector3d>& x) const { return x[tip].dot(along); }
  // Returns bounds of the space that the sheet may pass through.
  render::Box bounds() const;
};

// Clamps all vertices of a cloth from a file, a disc or a tube that are within the clamped length of its own
// low end in x: that pin becomes the scene's only one.  Throws Error::invalid_input for a cloth no longer
// than that, and for a flat sheet that gravity does not bend, because it stands on its edge or hangs; the
// message names the cloth.rotation that lays it level.
void clamp_low_end(Scene& scene);

// Locates the sheet.  If `clamped`, the experiment holds its low end in x.  Otherwise the scene's first pins
// hold it: it swings about the line through them, and its free end is the middle of the vertices farthest
// from that.
SheetPlacement sheet_placement(const Scene& scene, const Cloth& cloth, bool clamped);

// Warns that a sheet from a file is clamped by what looks like its long side; "" otherwise.
std::string long_side_warning(const Scene& scene, const ClothMesh& mesh);

// Throws the same error for a sheet that the experiment clamps itself.
void throw_if_gravity_bends_nothing(const Scene& scene, const ClothMesh& mesh);

}  // namespace hysteron::experiments
