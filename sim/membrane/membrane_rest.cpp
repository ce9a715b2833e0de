#include "sim/linear/power_iteration.h"
#include "sim/membrane/membrane.h"

namespace hysteron {

std::vector<MembraneRest<double>> membrane_rest(const ClothMesh& mesh) {
  std::vector<MembraneRest<double>> rest(mesh.faces());
  for (int f = 0; f < mesh.faces(); ++f) {
    const auto axes = mesh.face_axes(f);
    const auto at = mesh.corners(f);
    Eigen::Matrix2d d;
    for (int k = 0; k < 2; ++k) {
      const Eigen::Vector3d u = at[k + 1] - at[0];
      d.col(k) << u.dot(axes[0]), u.dot(axes[1]);
    }
    const Eigen::Matrix2d g = d.inverse();  // rows: gradients of the shape functions of corners 1 and 2
    rest[f].area = mesh.face_area[f];
    for (int k = 0; k < 2; ++k) {
      rest[f].b1[k + 1] = g(k, 0);
      rest[f].b2[k + 1] = g(k, 1);
    }
    rest[f].b1[0] = -rest[f].b1[1] - rest[f].b1[2];
    rest[f].b2[0] = -rest[f].b2[1] - rest[f].b2[2];
  }
  return rest;
}

double membrane_spectral_radius(const ClothMesh& mesh, const Fabric& fabric, const std::vector<double>& mass,
                                const std::vector<char>& held) {
  const auto rest = membrane_rest(mesh);
  const InPlaneStops& stops = fabric.in_plane;  // none slips
  const MembraneStiffness<double> c{fabric.warp + stops.warp.stiffness(),
                                    fabric.weft + stops.weft.stiffness(), fabric.coupling,
                                    fabric.shear + stops.shear.stiffness()};
  return largest_eigenvalue(mass, held, [&](const auto& v, auto& w) {
    std::fill(w.begin(), w.end(), Eigen::Vector3d::Zero());
    for (int f = 0; f < mesh.faces(); ++f) {
      const auto& t = mesh.face[f];
      const auto x = deformation(rest[f], mesh.rest[t[0]], mesh.rest[t[1]], mesh.rest[t[2]]);
      const auto g = deformation(rest[f], v[t[0]], v[t[1]], v[t[2]]);
      const auto s = membrane_stress(c, green_strain_rate(x, g));
      for (int k = 0; k < 3; ++k) w[t[k]] -= membrane_force(rest[f], x, s, k);
    }
  });
}

}  // namespace hysteron
