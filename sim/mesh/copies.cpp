#include "sim/mesh/cloth_mesh.h"

namespace hysteron {

ClothMesh copies_of(const ClothMesh& mesh, int copies, const Eigen::Vector3d& offset) {
  ClothMesh all;
  all.warp_axis = mesh.warp_axis;
  all.sewn = mesh.sewn;
  for (int k = 0; k < copies; ++k) {
    for (const Eigen::Vector3d& x : mesh.rest) all.rest.push_back(x + k * offset);
    for (const Eigen::Vector3i& t : mesh.face) all.face.push_back(t.array() + k * mesh.vertices());
    all.pattern.insert(all.pattern.end(), mesh.pattern.begin(), mesh.pattern.end());
    all.panel.insert(all.panel.end(), mesh.panel.begin(), mesh.panel.end());
  }
  build_topology(all, "copies of the mesh");
  return all;
}

}  // namespace hysteron
