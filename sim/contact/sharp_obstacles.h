// Which obstacles are sharper than the cloth's mesh, so that they enter its triangles between vertices.
#pragma once

#include "sim/mesh/cloth_mesh.h"
#include "sim/scene/scene.h"

namespace hysteron {

// Below this radius of curvature an obstacle is sharper than the mesh [m].
double sharp_radius(const Scene& scene, const ClothMesh& mesh);
bool is_sharper_than_mesh(const Scene& scene, const ClothMesh& mesh);

}  // namespace hysteron
