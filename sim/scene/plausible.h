// Whether a cloth can be what was meant: the commonest mistake of a mesh is its unit of length.
#pragma once

#include <string>
#include <vector>

#include "sim/mesh/cloth_mesh.h"
#include "sim/scene/scene.h"

namespace hysteron {

// A sentence for each: size, weight or edges that no cloth of that fabric has, with the units in which it
// would be one; a start that stretches it; a start whose history no file holds.  `start` [m] is where the
// vertices of the mesh start.
std::vector<std::string> cloth_doubts(const Scene& scene, const ClothMesh& mesh,
                                      const std::vector<Eigen::Vector3d>& start);

}  // namespace hysteron
