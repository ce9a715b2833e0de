#include "sim/contact/sharp_obstacles.h"

#include <algorithm>

#include "sim/contact/compression.h"
#include "sim/contact/obstacle_set.h"

namespace hysteron {

double sharp_radius(const Scene& scene, const ClothMesh& mesh) {
  double longest = 0;  // squared edge
  for (const Edge& e : mesh.edge)
    longest = std::max(longest, (mesh.rest[e.p3] - mesh.rest[e.p2]).squaredNorm());
  return longest / (6 * (1 - kCompressed) * scene.fabric.thickness);
}

bool is_sharper_than_mesh(const Scene& scene, const ClothMesh& mesh) {
  const double sharp = sharp_radius(scene, mesh);
  return std::any_of(scene.obstacle.begin(), scene.obstacle.end(),
                     [&](const Obstacle& o) { return sharpest_radius(o) < sharp; });
}

}  // namespace hysteron
