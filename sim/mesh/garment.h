// Garments: OBJs whose vertices say where cloth starts, and something else what it is at rest.
#pragma once

#include <string>
#include <vector>

#include "sim/mesh/cloth_mesh.h"

namespace hysteron {

// The cloth of an OBJ at rest as its texture coordinates have it [m], flat in z = 0.  Throws as read_obj
// does, and Error::request where a corner has none, a vertex several (along a seam), or the flat cloth is
// folded.
ClothMesh read_pattern(const std::string& file, double weld);

// Where the OBJ's vertices are [m]; its triangles must be those of `mesh`.  Throws as read_obj does, and
// Error::request for other triangles.
std::vector<Eigen::Vector3d> read_start(const std::string& file, double weld, const ClothMesh& mesh);

}  // namespace hysteron
