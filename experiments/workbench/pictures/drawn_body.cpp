#include "experiments/workbench/pictures/drawn_body.h"

#include <algorithm>
#include <cmath>

#include "experiments/workbench/pictures/archived_geometry.h"
#include "experiments/workbench/pictures/drawing.h"

namespace hysteron::experiments {

double body_quantum(const Obstacle& body, double cloth_quantum) {
  double largest = 1;
  for (const Keyframe& key : body.motion.keys) largest = std::max(largest, key.scale);
  return cloth_quantum / largest;
}

std::vector<float> drawn_body(const Obstacle& body, double time, double quantum) {
  const std::vector<float> xyz = flat_points(body.mesh->positions(time));
  return quantum > 0 ? rounded(xyz, quantum) : xyz;
}

// The surface is not rounded, because cloth lies on its triangles, not only with its vertices; they cut
// nothing from it.
render::TriangleMesh body_surface(const BodyMesh& body, const std::vector<float>& xyz) {
  std::vector<Eigen::Vector3d> position;
  for (std::size_t i = 0; i + 2 < xyz.size(); i += 3) position.emplace_back(xyz[i], xyz[i + 1], xyz[i + 2]);
  render::TriangleMesh mesh = render::smooth_mesh(position, body.face);
  mesh.roundness = INFINITY;
  mesh.closed = body.closed;
  return mesh;
}

}  // namespace hysteron::experiments
