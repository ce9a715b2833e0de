// Membrane locking: triangles of constant strain are flat, and mesh edges that do not lie along a fold must
// be stretched for the cloth to bend across them.  Where triangles are stiff beside bending, coarse cloth
// bends less than its rigidity says.  Means of strains at nodes (membrane_nodes.h) leave them soft.
#pragma once

#include <string>

#include "sim/mesh/cloth_mesh.h"
#include "sim/scene/scene.h"

namespace hysteron {

// E h^2/b2, dimensionless: the square of an edge over the thickness of the plate that has this membrane and
// this rigidity, but for a factor of 12.  E: the larger of warp and weft [N/m] that triangles have, since
// threads that are stiff one way lock the mesh nearly as much as both; h: the side of an equilateral triangle
// of mean area [m]; b2: where faces differ the mean of both sides, to which cloth folds.
double locking_number(const Scene& scene, const ClothMesh& mesh);

// A warning where the number is above what was measured to matter (locking.cpp); "" below.
std::string locking_words(const Scene& scene, const ClothMesh& mesh);

}  // namespace hysteron
