// Finds a point of the cloth by its place on the flat cloth.
#pragma once

#include <optional>
#include <vector>

#include "sim/mesh/cloth_mesh.h"

namespace hysteron {

struct MaterialPoint {
  int face = 0;
  Eigen::Vector3d weight{1, 0, 0};  // barycentric, for the face's corners

  // Returns where it is when the vertices are at x [m].
  Eigen::Vector3d among(const ClothMesh& mesh, const std::vector<Eigen::Vector3d>& x) const;
};

// Does each triangle lie in a plane z = constant at rest? The cloth is then in one piece, copies above each
// other, or panels.
bool is_flat(const ClothMesh& mesh);

// Returns the point (x, y) of a flat cloth at rest [m], in the first triangle that contains it or misses it
// by less than 1 nm; none if it is beside the cloth.
std::optional<MaterialPoint> material_point(const ClothMesh& mesh, const Eigen::Vector2d& at);

// Returns the hinge, among the point's face's edges, that is nearest to it on the flat cloth; -1 where the
// face has none.
int nearest_hinge(const ClothMesh& mesh, const MaterialPoint& point);

}  // namespace hysteron
