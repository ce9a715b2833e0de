// Measures membrane locking.  Triangles of constant strain are flat, and mesh edges that do not lie along a
// fold must be stretched for the cloth to bend across them.  Where triangles are stiff beside bending, coarse
// cloth bends less than its rigidity says.  Means of strains at nodes (membrane_nodes.h) leave them soft.
#pragma once

#include <string>

#include "sim/mesh/cloth_mesh.h"
#include "sim/scene/scene.h"

namespace hysteron {

// Returns E h^2/b2, dimensionless: but for a factor of 12 it is the square of an edge over the thickness of
// the plate with this membrane and rigidity.  E is the larger of the triangles' warp and weft stiffness
// [N/m], since threads that are stiff one way lock the mesh nearly as much as both; h is the side of an
// equilateral triangle of mean area [m]; b2, where faces differ, is the mean of both sides [N m], to which
// cloth folds.
double locking_number(const Scene& scene, const ClothMesh& mesh);

// Warns if the number is above the one that was measured to matter (locking.cpp); "" below.
std::string locking_warning(const Scene& scene, const ClothMesh& mesh);

}  // namespace hysteron
