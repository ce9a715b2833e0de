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

namespace {

// Adds to the triangles' stress that of the means of their strain rates at nodes.
void add_nodal_stress(const ClothMesh& mesh, const MembraneNodes& nodes, const MembraneStiffness<double>& c,
                      const std::vector<Eigen::Vector3d>& strain,
                      std::vector<MembraneStress<double>>& stress) {
  std::vector<Eigen::Vector3d> mean(nodes.count(), Eigen::Vector3d::Zero());
  const auto each = [&](const auto& visit) {
    for (int f = 0; f < mesh.faces(); ++f)
      for (int k = 0; k < 3; ++k) visit(f, nodes.of_face[f][k]);
  };
  each([&](int f, int n) { mean[n] += mesh.face_area[f] / (3 * nodes.area[n]) * strain[f]; });
  each([&](int f, int n) {
    const auto s = membrane_stress(c, mean[n]);
    stress[f].s11 += s.s11 / 3;
    stress[f].s22 += s.s22 / 3;
  });
}

void add_stops(const InPlaneStops& stops, MembraneStiffness<double>& c) {
  c.warp += stops.warp.stiffness();
  c.weft += stops.weft.stiffness();
  c.shear += stops.shear.stiffness();
}

}  // namespace

double membrane_spectral_radius(const ClothMesh& mesh, const Fabric& fabric, MembraneElement element,
                                const std::vector<double>& mass, const std::vector<char>& held) {
  const auto rest = membrane_rest(mesh);
  MembraneSplit c = split_membrane(fabric, element);
  add_stops(stops_of_faces(fabric, c), c.faces);  // none slips
  add_stops(stops_of_nodes(fabric, c), c.nodes);
  const MembraneNodes nodes = c.averages ? membrane_nodes(mesh) : MembraneNodes{};
  std::vector<Eigen::Vector3d> strain(mesh.faces());
  std::vector<MembraneStress<double>> stress(mesh.faces());
  std::vector<Deformation<double>> deformed;
  for (int f = 0; f < mesh.faces(); ++f) {
    const auto& t = mesh.face[f];
    deformed.push_back(deformation(rest[f], mesh.rest[t[0]], mesh.rest[t[1]], mesh.rest[t[2]]));
  }
  return largest_eigenvalue(mass, held, [&](const auto& v, auto& w) {
    for (int f = 0; f < mesh.faces(); ++f) {
      const auto& t = mesh.face[f];
      strain[f] = green_strain_rate(deformed[f], deformation(rest[f], v[t[0]], v[t[1]], v[t[2]]));
      stress[f] = membrane_stress(c.faces, strain[f]);
    }
    if (c.averages) add_nodal_stress(mesh, nodes, c.nodes, strain, stress);
    std::fill(w.begin(), w.end(), Eigen::Vector3d::Zero());
    for (int f = 0; f < mesh.faces(); ++f)
      for (int k = 0; k < 3; ++k) w[mesh.face[f][k]] -= membrane_force(rest[f], deformed[f], stress[f], k);
  });
}

}  // namespace hysteron
