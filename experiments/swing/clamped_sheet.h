// The sheet of the swing: where its clamp and its free end are, and along what it swings.
#pragma once

#include <vector>

#include "render/camera.h"
#include "sim/scene/cloth.h"

namespace hysteron::experiments {

inline constexpr double kClampedLength = 0.01;  // [m]: the rest of the sheet swings

// A sheet that is a rectangle from x = 0 on, as cloth.shape makes it.
bool is_flat_rectangle(const Scene& scene);

struct SheetPlacement {
  double length = 0, width = 0;  // at rest, along x and across [m]
  int clamp = 0, tip = 0;        // vertices: one that is held, and the free end's middle
  Eigen::Vector3d corner;        // of the clamped end and the low side, or the pins' middle, at the start [m]
  Eigen::Vector3d along;         // the horizontal direction in the plane in which the sheet swings
  Eigen::Vector3d across;        // along the width, or the pins
  Eigen::Vector3d up;            // against gravity
  double reach = 0;              // of a sheet that is held by the scene's pins, from their middle [m]

  // How far the free end is along the swing's direction [m].
  double swing(const std::vector<Eigen::Vector3d>& x) const { return x[tip].dot(along); }
  // What the sheet may pass through.
  render::Box bounds() const;
};

// Holds all vertices of a cloth from a file, a disc or a tube that are within the clamped length of its own
// low end in x: that pin becomes the scene's only one.  Error::invalid_input for a cloth that is no longer
// than that, and for a flat sheet that gravity does not bend, because it stands on its edge or hangs: which
// cloth.rotation lays it level is named.
void clamp_low_end(Scene& scene);

// `clamped`: the low end in x is, by the experiment.  Otherwise the scene's first pins hold the sheet: it
// swings about the line that they lie along, and its free end is the middle of what is farthest from that.
SheetPlacement sheet_placement(const Scene& scene, const Cloth& cloth, bool clamped);

// Says that a sheet from a file is clamped by what looks like its long side; "" of others.
std::string long_side_warning(const Scene& scene, const ClothMesh& mesh);

// The same refusal, of a sheet that the experiment clamps itself.
void throw_if_gravity_bends_nothing(const Scene& scene, const ClothMesh& mesh);

}  // namespace hysteron::experiments
