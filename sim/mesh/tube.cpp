// Tubes: a rectangle rolled up and sewn along its length, as a sleeve or a trouser leg is.
#include <cmath>
#include <numbers>

#include "sim/base/error.h"
#include "sim/mesh/builders.h"
#include "sim/mesh/weld.h"

namespace hysteron {
namespace {

// Edges that lie on neither end are open: the two sides of the seam did not meet.
bool is_closed(const ClothMesh& mesh, double length) {
  const auto at_end = [&](int vertex) {
    const double x = mesh.rest[vertex].x();
    return std::min(std::abs(x), std::abs(x - length)) < 1e-9 * length;
  };
  for (std::size_t e = mesh.interior_edges; e < mesh.edge.size(); ++e)
    if (!at_end(mesh.edge[e].p2) || !at_end(mesh.edge[e].p3)) return false;
  return true;
}

}  // namespace

ClothMesh make_tube(double length, double radius, int triangles, MeshFamily family, unsigned seed) {
  check_length("tube", "radius", radius);
  const double around = 2 * std::numbers::pi * radius;
  const ClothMesh flat = make_rectangle(length, around, triangles, family, seed);
  ClothMesh tube;
  std::vector<Eigen::Vector3d> rolled;
  for (const Eigen::Vector3d& x : flat.rest) {
    const double angle = x.y() / radius;
    rolled.push_back({x.x(), -radius * std::sin(angle), -radius * std::cos(angle)});
  }
  constexpr double kSeam = 1e-6;  // of the radius: far below any edge, far above rounding
  const std::vector<int> kept = nearby_representatives(rolled, kSeam * radius);
  std::vector<int> number(rolled.size());
  for (std::size_t i = 0; i < rolled.size(); ++i) {
    number[i] = kept[i] < static_cast<int>(i) ? number[kept[i]] : static_cast<int>(tube.rest.size());
    if (kept[i] == static_cast<int>(i)) tube.rest.push_back(rolled[i]);
  }
  for (const Eigen::Vector3i& t : flat.face) tube.face.push_back({number[t[0]], number[t[1]], number[t[2]]});
  build_topology(tube, "tube mesh");
  if (!is_closed(tube, length))
    throw Error::request("tube mesh: the two sides of the seam do not meet with mesh = " + to_string(family) +
                         " and " + std::to_string(triangles) + " triangles; take mesh = unionjack");
  return tube;
}

}  // namespace hysteron
