#include "sim/membrane/locking.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numeric>

namespace hysteron {

namespace {

constexpr double kLocks = 1e5;

double mean_edge(const ClothMesh& mesh) {
  const double area = std::accumulate(mesh.face_area.begin(), mesh.face_area.end(), 0.0);
  return std::sqrt(4 / std::sqrt(3.0) * area / mesh.faces());
}

}  // namespace

double locking_number(const Scene& scene, const ClothMesh& mesh) {
  const double edge = mean_edge(mesh), stiffness = std::min(scene.fabric.warp, scene.fabric.weft);
  return stiffness * edge * edge / scene.fabric.b2;
}

std::string locking_words(const Scene& scene, const ClothMesh& mesh) {
  const double number = locking_number(scene, mesh);
  if (!(number > kLocks) || !std::isfinite(number)) return "";
  char text[400];
  std::snprintf(
      text, sizeof text,
      "the membrane may lock: edges of %.3g mm are long for fabric.warp = %.3g N/m, fabric.weft = %.3g "
      "N/m and fabric.b2 = %.3g N m, so that the cloth bends less than it should (E h^2/b2 = %.2g, "
      "above %.0e): take some %.0f times as many triangles, or a softer membrane",
      1e3 * mean_edge(mesh), scene.fabric.warp, scene.fabric.weft, scene.fabric.b2, number, kLocks,
      std::ceil(number / kLocks));
  return text;
}

}  // namespace hysteron
