#include <algorithm>

#include "sim/contact/body_vertices.h"
#include "sim/scene/body.h"

namespace hysteron {

bool has_mesh_bodies(const Scene& scene) {
  return std::any_of(scene.obstacle.begin(), scene.obstacle.end(), is_body);
}

ClothMesh mesh_with_bodies(const ClothMesh& cloth, const Scene& scene) {
  ClothMesh all;
  all.rest = cloth.rest;
  all.face = cloth.face;
  for (const Obstacle& o : scene.obstacle) {
    if (!is_body(o)) continue;
    const Eigen::Vector3i first = Eigen::Vector3i::Constant(all.vertices());
    for (const Eigen::Vector3d& x : body_positions(o, 0)) all.rest.push_back(x);
    for (const Eigen::Vector3i& f : o.mesh->face) all.face.push_back(f + first);
  }
  build_topology(all, "cloth and bodies");
  std::copy(cloth.face_area.begin(), cloth.face_area.end(), all.face_area.begin());
  std::copy(cloth.vertex_area.begin(), cloth.vertex_area.end(), all.vertex_area.begin());
  return all;
}

}  // namespace hysteron
