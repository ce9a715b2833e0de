// Finer meshes of the same surface: each triangle cut into four at the middles of its sides.
#pragma once

#include <vector>

#include "sim/mesh/cloth_mesh.h"

namespace hysteron {

// The same cloth, at rest and in texture coordinates: first its vertices, then the middle of each edge; the
// triangles of each triangle one after another.  Throws Error::request beyond 10 million triangles.
ClothMesh subdivided(const ClothMesh& mesh);

// Places of the vertices [m], followed by those of the edges' middles.
std::vector<Eigen::Vector3d> with_middles(const ClothMesh& mesh, std::vector<Eigen::Vector3d> x);

}  // namespace hysteron
