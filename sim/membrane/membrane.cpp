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

// MembraneBlocks::sum.
template <class Real, class Device>
std::vector<Eigen::Vector2i> block_terms(const ClothMesh& mesh, const BlockRows<Real, Device>& rows) {
  std::vector<Eigen::Vector2i> terms(rows.col().size(), Eigen::Vector2i(-1, -1));
  for (int v = 0; v < mesh.vertices(); ++v)
    for (int n = mesh.vertex_faces.start[v]; n < mesh.vertex_faces.start[v + 1]; ++n) {
      const int face = mesh.vertex_faces.item[n] / 3, i = mesh.vertex_faces.item[n] % 3;
      for (const int j : {(i + 1) % 3, (i + 2) % 3}) {
        Eigen::Vector2i& of = terms[rows.slot(v, mesh.face[face][j])];
        of[of[0] < 0 ? 0 : 1] = 9 * face + 3 * i + j;
      }
    }
  return terms;
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
      block_sum_(device, block_terms(mesh, rows)),
      deformation_(device, faces_),
      stress_(device, faces_),
      tension_(device, faces_),
      measure_(device, faces_),
      viscous_(device, damping_ > 0 ? faces_ : 0),
      friction_(device, fabric.in_plane, faces_) {}

template <class Real, class Device>
void Membrane<Real, Device>::update(const Vec3<Real>* x, const Vec3<Real>* v) {
  const MembraneStiffness<Real> c = stiffness_;
  const Real damping = damping_;
  const MembraneRest<Real>* rest = rest_.data();
  const Eigen::Vector3i* corner = corner_.data();
  Deformation<Real>* deformed = deformation_.data();
  MembraneStress<Real>*stress = stress_.data(), *tension = tension_.data();
  for_each(
      device_,
      {"membrane stress",
       bytes_of(rest_, corner_, deformation_, stress_, tension_) + (damping > 0 ? 2 : 1) * vertex_bytes()},
      faces_, HYST_KERNEL(int f) {
        const Eigen::Vector3i t = corner[f];
        const Deformation<Real> d = deformation(rest[f], x[t[0]], x[t[1]], x[t[2]]);
        Vec3<Real> strain = green_strain(d);
        tension[f] = tensile_part(membrane_stress(c, strain));
        if (damping > 0)
          strain += damping * green_strain_rate(d, deformation(rest[f], v[t[0]], v[t[1]], v[t[2]]));
        deformed[f] = d;
        stress[f] = membrane_stress(c, strain);
      });
  if (friction_.any()) friction_.add(c, stressed());
}

template <class Real, class Device>
MembraneForceView<Real> Membrane<Real, Device>::forces() const {
  return {vertex_start_.data(), vertex_item_.data(), rest_.data(), deformation_.data(), stress_.data()};
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
  if (friction_.any()) friction_.add_stored(rest, corner, x, energy);
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
      device_, {"viscous loss", bytes_of(rest_, corner_, deformation_, viscous_, viscous_) + vertex_bytes()},
      faces_, HYST_KERNEL(int f) {
        const Eigen::Vector3i t = corner[f];
        const Vec3<Real> rate =
            green_strain_rate(deformed[f], deformation(rest[f], v[t[0]], v[t[1]], v[t[2]]));
        lost[f] += static_cast<double>(factor * rest[f].area * membrane_energy(c, rate));
      });
}

template <class Real, class Device>
void Membrane<Real, Device>::start_friction(const Vec3<Real>* x) {
  if (friction_.any()) friction_.commit(rest_.data(), corner_.data(), x, true);
}

template <class Real, class Device>
void Membrane<Real, Device>::commit_friction(const Vec3<Real>* x) {
  if (friction_.any()) friction_.commit(rest_.data(), corner_.data(), x, false);
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
  return bytes_of(rest_, corner_, vertex_start_, vertex_item_, block_sum_, deformation_, stress_, tension_,
                  measure_, viscous_, reference_) +
         friction_.bytes();
}

template class Membrane<double, ThisDevice>;
template class Membrane<float, ThisDevice>;

}  // namespace hysteron
