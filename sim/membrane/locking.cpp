#include "sim/membrane/locking.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numeric>

#include "sim/bending/laws/law_parameters.h"
#include "sim/membrane/membrane_nodes.h"

namespace hysteron {

namespace {

// Measured drape coefficients of cotton broad (`drape --quick`) with strains of triangles, and the locking
// number:
//   warp, weft [kN/m]    1, 1          3, 3         10, 10        100, 100      100, 1
//   600 triangles        76.0 % 2e4    79.6 % 7e4   84.5 % 2e5    90.9 % 2e6    87.1 % 2e6
//   1,200                79.0 % 1e4                 86.4 % 1e5
// In each decade some 2 points are the sheet's own, as means at nodes show (results/drape-tension).
constexpr double kLocks = 1e5;

// Returns the side of the equilateral triangle that has the mean area [m].
double equilateral_side(const ClothMesh& mesh) {
  const double area = std::accumulate(mesh.face_area.begin(), mesh.face_area.end(), 0.0);
  return std::sqrt(4 / std::sqrt(3.0) * area / mesh.faces());
}

}  // namespace

double locking_number(const Scene& scene, const ClothMesh& mesh) {
  const MembraneStiffness<double> of = split_membrane(scene.fabric, scene.membrane_element).faces;
  const double edge = equilateral_side(mesh), stiffness = std::max(of.warp, of.weft);
  return stiffness * edge * edge / mean_of_faces(scene.fabric.virgin_curve()).b2;
}

std::string locking_warning(const Scene& scene, const ClothMesh& mesh) {
  const double number = locking_number(scene, mesh);
  if (!(number > kLocks) || !std::isfinite(number)) return "";
  const bool averages = split_membrane(scene.fabric, scene.membrane_element).averages;
  const bool may_average =
      std::max(scene.fabric.warp, scene.fabric.weft) > kMaxTriangleStiffness && !averages;
  char text[400];
  std::snprintf(
      text, sizeof text,
      "the membrane may lock: edges of %.3g mm are long for fabric.warp = %.3g N/m, fabric.weft = %.3g "
      "N/m and fabric.b2 = %.3g N m%s, so that the cloth bends less than it should (E h^2/b2 = %.2g, "
      "above %.0e): take %ssome %.0f times as many triangles, or a softer membrane",
      1e3 * equilateral_side(mesh), scene.fabric.warp, scene.fabric.weft,
      mean_of_faces(scene.fabric.virgin_curve()).b2,
      scene.fabric.bending.faces.on() ? " (the mean of both sides)" : "", number, kLocks,
      may_average ? "membrane.element = nodal, or " : "", std::ceil(number / kLocks));
  return text;
}

}  // namespace hysteron
