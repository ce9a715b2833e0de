// The positions of a mesh in motion as a point cache, which Blender's modifier Mesh Cache and Houdini's node
// Point Cache play on the mesh of an OBJ file.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "sim/mesh/cloth_mesh.h"

namespace hysteron {

// Writes the positions [m] of instant 0, 1, ... into a PC2 file, in single precision: instant 0 begins a new
// file, each other one follows the one before it in the file.  A file that is cut short is whole up to its
// last instant.  Throws Error::system.
void write_to_point_cache(const std::string& file, std::size_t instant,
                          const std::vector<Eigen::Vector3d>& position);

}  // namespace hysteron
