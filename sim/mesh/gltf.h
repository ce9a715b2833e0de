// A cloth in motion as one binary glTF file, for browsers, Blender and game engines.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "sim/mesh/cloth_mesh.h"

namespace hysteron {

struct ClothFrame {
  double time;             // [s]
  std::vector<float> xyz;  // 3 a vertex [m], z up
};

// Of a frame after the first, for each vertex: displacement and change of the normal, 3 floats each.
inline constexpr std::size_t kMorphBytes = 24;

// One mesh [m] that faces y as glTF has it, (x, y, z) here being (x, z, -y) there: positions and normals of
// the first frame, a morph target for each of the others, and an animation whose weights lead linearly
// from one to the next.  Throws Error::request for no frames, for times [s] that do not ascend in single
// precision, for frames of another size than the mesh, and beyond the 4 GiB that the format counts to;
// Error::machine where the file cannot be written.
void write_glb(const std::string& file, const ClothMesh& mesh, const std::vector<ClothFrame>& frames);

}  // namespace hysteron
