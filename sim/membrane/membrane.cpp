#include "sim/membrane/membrane.h"

#include <numeric>

namespace hysteron {

namespace {

template <class Real>
std::vector<MembraneRest<Real>> rest_as(const ClothMesh& mesh) {
  std::vector<MembraneRest<Real>> result;
  for (const MembraneRest<double>& r : membrane_rest(mesh)) {
    MembraneRest<Real> c;
    c.area = static_cast<Real>(r.area);
    for (int k = 0; k < 3; ++k) {
      c.b1[k] = static_cast<Real>(r.b1[k]);
      c.b2[k] = static_cast<Real>(r.b2[k]);
    }
    result.push_back(c);
  }
  return result;
}

template <class Real, class Device>
std::vector<int> matrix_slots(const ClothMesh& mesh, const BlockRows<Real, Device>& rows) {
  std::vector<int> slots;
  for (int v = 0; v < mesh.vertices(); ++v)
    for (int j = mesh.vertex_faces.start[v]; j < mesh.vertex_faces.start[v + 1]; ++j) {
      const int item = mesh.vertex_faces.item[j];
      const auto& t = mesh.face[item / 3];
      for (int k = 1; k < 3; ++k) slots.push_back(rows.slot(v, t[(item % 3 + k) % 3]));
    }
  return slots;
}

}  // namespace

template <class Real, class Device>
Membrane<Real, Device>::Membrane(Device& device, const ClothMesh& mesh, const Fabric& fabric,
                                 const BlockRows<Real, Device>& rows)
    : device_(device),
      faces_(mesh.faces()),
      vertices_(mesh.vertices()),
      stiffness_{static_cast<Real>(fabric.warp), static_cast<Real>(fabric.weft),
                 static_cast<Real>(fabric.coupling), static_cast<Real>(fabric.shear)},
      damping_(static_cast<Real>(fabric.damping)),
      rest_(device, rest_as<Real>(mesh)),
      corner_(device, mesh.face),
      vertex_start_(device, mesh.vertex_faces.start),
      vertex_item_(device, mesh.vertex_faces.item),
      slot_(device, matrix_slots(mesh, rows)),
      deformation_(device, faces_),
      stress_(device, faces_),
      tension_(device, faces_),
      measure_(device, faces_),
      viscous_(device, damping_ > 0 ? faces_ : 0) {}

template <class Real, class Device>
void Membrane<Real, Device>::update(const Vec3<Real>* x, const Vec3<Real>* v) {
  const MembraneStiffness<Real> c = stiffness_;
  const Real damping = damping_;
  const MembraneRest<Real>* rest = rest_.data();
  const Eigen::Vector3i* corner = corner_.data();
  Deformation<Real>* deformed = deformation_.data();
  MembraneStress<Real>*stress = stress_.data(), *tension = tension_.data();
  for_each(
      device_, "membrane stress", faces_, HYST_KERNEL(int f) {
        const Eigen::Vector3i t = corner[f];
        const Deformation<Real> d = deformation(rest[f], x[t[0]], x[t[1]], x[t[2]]);
        Vec3<Real> strain = green_strain(d);
        tension[f] = tensile_part(membrane_stress(c, strain));
        if (damping > 0)
          strain += damping * green_strain_rate(d, deformation(rest[f], v[t[0]], v[t[1]], v[t[2]]));
        deformed[f] = d;
        stress[f] = membrane_stress(c, strain);
      });
}

template <class Real, class Device>
MembraneForceView<Real> Membrane<Real, Device>::forces() const {
  return {vertex_start_.data(), vertex_item_.data(), rest_.data(), deformation_.data(), stress_.data()};
}

template <class Real, class Device>
void Membrane<Real, Device>::assemble(Real factor, Real geometric, BlockRowsView<Real> matrix,
                                      ScalarRowsView<Real> softening) {
  const MembraneStiffness<Real> c = stiffness_;
  const int *start = vertex_start_.data(), *item = vertex_item_.data(), *slot = slot_.data();
  const MembraneRest<Real>* rest = rest_.data();
  const Deformation<Real>* deformed = deformation_.data();
  const MembraneStress<Real>* tension = tension_.data();
  for_each(
      device_, "membrane matrix", vertices_, HYST_KERNEL(int v) {
        for (int j = matrix.row_ptr[v]; j < matrix.row_ptr[v + 1]; ++j) matrix.off_diagonal[j].setZero();
        Mat3<Real> diagonal = Mat3<Real>::Zero();
        for (int j = start[v]; j < start[v + 1]; ++j) {
          const int f = item[j] / 3, i = item[j] % 3;
          const MembraneStress<Real> s = tension[f];
          const MembraneStress<Real> t{geometric * s.s11, geometric * s.s22, geometric * s.s12};
          diagonal += membrane_block(rest[f], c, factor, deformed[f], t, i, i);
          for (int k = 1; k < 3; ++k)
            matrix.off_diagonal[slot[2 * j + k - 1]] +=
                membrane_block(rest[f], c, factor, deformed[f], t, i, (i + k) % 3);
        }
        matrix.diagonal[v] = diagonal;
      });
  if (softening.off_diagonal) assemble_softening(matrix, softening);
}

template <class Real, class Device>
void Membrane<Real, Device>::assemble_softening(BlockRowsView<Real> matrix, ScalarRowsView<Real> softening) {
  const int *start = vertex_start_.data(), *item = vertex_item_.data(), *slot = slot_.data();
  const MembraneRest<Real>* rest = rest_.data();
  const MembraneStress<Real>*stress = stress_.data(), *tension = tension_.data();
  for_each(
      device_, "membrane softening", vertices_, HYST_KERNEL(int v) {
        for (int j = matrix.row_ptr[v]; j < matrix.row_ptr[v + 1]; ++j) softening.off_diagonal[j] = 0;
        Real diagonal = 0;
        for (int j = start[v]; j < start[v + 1]; ++j) {
          const int f = item[j] / 3, i = item[j] % 3;
          const MembraneStress<Real> s = stress[f], t = tension[f];
          const MembraneStress<Real> compression{s.s11 - t.s11, s.s22 - t.s22, s.s12 - t.s12};
          diagonal += geometric_stiffness(rest[f], compression, i, i);
          for (int k = 1; k < 3; ++k)
            softening.off_diagonal[slot[2 * j + k - 1]] +=
                geometric_stiffness(rest[f], compression, i, (i + k) % 3);
        }
        softening.diagonal[v] = diagonal;
      });
}

template <class Real, class Device>
double Membrane<Real, Device>::stored_energy(const Vec3<Real>* x) {
  const MembraneStiffness<Real> c = stiffness_;
  const MembraneRest<Real>* rest = rest_.data();
  const Eigen::Vector3i* corner = corner_.data();
  double* energy = measure_.data();
  for_each(
      device_, "membrane energy", faces_, HYST_KERNEL(int f) {
        const Eigen::Vector3i t = corner[f];
        const Vec3<Real> strain = green_strain(deformation(rest[f], x[t[0]], x[t[1]], x[t[2]]));
        energy[f] = static_cast<double>(rest[f].area * membrane_energy(c, strain));
      });
  const std::vector<double> values = measure_.download();
  return std::accumulate(values.begin(), values.end(), 0.0);
}

template <class Real, class Device>
void Membrane<Real, Device>::add_viscous_loss(const Vec3<Real>* v, Real step) {
  if (damping_ <= 0) return;
  const MembraneStiffness<Real> c = stiffness_;
  const Real factor = 2 * step * damping_;  // the rate form e'Ce' is twice membrane_energy(e')
  const MembraneRest<Real>* rest = rest_.data();
  const Eigen::Vector3i* corner = corner_.data();
  const Deformation<Real>* deformed = deformation_.data();
  double* lost = viscous_.data();
  for_each(
      device_, "viscous loss", faces_, HYST_KERNEL(int f) {
        const Eigen::Vector3i t = corner[f];
        const Vec3<Real> rate =
            green_strain_rate(deformed[f], deformation(rest[f], v[t[0]], v[t[1]], v[t[2]]));
        lost[f] += static_cast<double>(factor * rest[f].area * membrane_energy(c, rate));
      });
}

template <class Real, class Device>
double Membrane<Real, Device>::viscous_loss() const {
  const std::vector<double> values = viscous_.download();
  return std::accumulate(values.begin(), values.end(), 0.0);
}

template <class Real, class Device>
double Membrane<Real, Device>::largest_stretch(const Vec3<Real>* x) {
  const MembraneRest<Real>* rest = rest_.data();
  const Eigen::Vector3i* corner = corner_.data();
  double* stretch = measure_.data();
  for_each(
      device_, "stretch", faces_, HYST_KERNEL(int f) {
        const Eigen::Vector3i t = corner[f];
        const Deformation<Real> d = deformation(rest[f], x[t[0]], x[t[1]], x[t[2]]);
        const Real a = d.f1.squaredNorm(), b = d.f2.squaredNorm(), s = d.f1.dot(d.f2);
        const Real largest = (a + b) / 2 + sqrt((a - b) * (a - b) / 4 + s * s);
        stretch[f] = static_cast<double>(sqrt(largest) - 1);
      });
  const std::vector<double> values = measure_.download();
  double largest = 0;
  for (double value : values) largest = value > largest || value != value ? value : largest;
  return largest;
}

template <class Real, class Device>
std::size_t Membrane<Real, Device>::bytes() const {
  return rest_.bytes() + corner_.bytes() + vertex_start_.bytes() + vertex_item_.bytes() + slot_.bytes() +
         deformation_.bytes() + stress_.bytes() + tension_.bytes() + measure_.bytes() + viscous_.bytes() +
         reference_.bytes();
}

template class Membrane<double, ThisDevice>;
template class Membrane<float, ThisDevice>;

}  // namespace hysteron
