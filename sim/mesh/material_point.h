// A point of the cloth, found by where it lies on the flat cloth.
#pragma once

#include <optional>
#include <vector>

#include "sim/mesh/cloth_mesh.h"

namespace hysteron {

struct MaterialPoint {
  int face = 0;
  Eigen::Vector3d weight{1, 0, 0};  // barycentric: of the face's corners

  // Where it is when the vertices are at x [m].
  Eigen::Vector3d among(const ClothMesh& mesh, const std::vector<Eigen::Vector3d>& x) const;
};

// Whether each triangle lies in a plane z = constant at rest: cloth in one piece, copies of it above each
// other, or panels.
bool is_flat(const ClothMesh& mesh);

// The point (x, y) of a flat cloth at rest [m], in the first triangle that contains it or passes it by less
// than 1 nm; none beside the cloth.
std::optional<MaterialPoint> material_point(const ClothMesh& mesh, const Eigen::Vector2d& at);

// The hinge, among its face's edges, that is nearest to it on the flat cloth; -1 where the face has none.
int nearest_hinge(const ClothMesh& mesh, const MaterialPoint& point);

}  // namespace hysteron
