#include "sim/bending/bending.h"

#include <numeric>

#include "sim/bending/stiffness_product.h"
#include "sim/linear/compressed_rows.h"

namespace hysteron {

namespace {

template <class Real>
std::vector<Real> cast(const std::vector<double>& values) {
  return std::vector<Real>(values.begin(), values.end());
}

std::vector<Eigen::Vector4i> hinge_corners(const ClothMesh& mesh) {
  std::vector<Eigen::Vector4i> corners;
  for (int i = 0; i < mesh.interior_edges; ++i) {
    const Edge& e = mesh.edge[i];
    corners.emplace_back(e.p0, e.p1, e.p2, e.p3);
  }
  return corners;
}

Adjacency vertex_hinges(const ClothMesh& mesh) {
  const std::vector<Eigen::Vector4i> corners = hinge_corners(mesh);
  std::vector<std::vector<int>> items(mesh.vertices());
  for (std::size_t h = 0; h < corners.size(); ++h)
    for (int k = 0; k < 4; ++k) items[corners[h][k]].push_back(static_cast<int>(4 * h + k));
  return compressed(items);
}

// The chapter's printed distribution (Wong, Leach, Zambetta 2013, 4.3.1) is kept as printed: it has a factor
// 1/2, no |e|, and one common t for both forces, which breaks angular momentum unless t = 1/2.
template <class Real>
HYST_HD void chapter_forces(const Vec3<Real>& p0, const Vec3<Real>& p1, const Vec3<Real>& p2,
                            const Vec3<Real>& p3, Real moment, Vec3<Real>* force) {
  const Vec3<Real> e = p3 - p2;
  const Real t0 = e.dot(p0 - p2) / e.dot(e), t1 = e.dot(p1 - p2) / e.dot(e);
  const Vec3<Real> l0 = p0 - (p2 + t0 * e), l1 = p1 - (p2 + t1 * e);
  const Real h0 = l0.norm(), h1 = l1.norm(), t = t0 + (t1 - t0) * h0 / (h0 + h1);
  force[0] = -(moment / (2 * h0)) * e.cross(l0).normalized();
  force[1] = -(moment / (2 * h1)) * l1.cross(e).normalized();
  force[2] = -(t * force[0] + (1 - t) * force[1]);
  force[3] = -((1 - t) * force[0] + t * force[1]);
}

}  // namespace

template <class Real, class Device>
Bending<Real, Device>::Bending(Device& device, const ClothMesh& mesh, const CurvatureOperator& op,
                               std::unique_ptr<LawLoop<Real, Device>> law, ForceConvention convention,
                               double viscosity)
    : device_(device),
      dimension_(op.dimension),
      elements_(op.elements()),
      hinges_(mesh.interior_edges),
      convention_(convention),
      viscosity_(static_cast<Real>(viscosity)),
      law_(std::move(law)),
      metric_(op.metric),
      area_(device, cast<Real>(op.area)),
      coefficient_(device, cast<Real>(op.coefficient)),
      direction_(device, cast<Real>(op.direction)),
      elastic_(device, cast<Real>(op.elastic)),
      transposed_(device, cast<Real>(op.transposed)),
      rest_angle_(device, cast<Real>(op.rest_angle)),
      row_start_(device, op.hinge.start),
      row_hinge_(device, op.hinge.item),
      column_start_(device, op.element.start),
      column_element_(device, op.element.item),
      corner_(device, hinge_corners(mesh)),
      angle_(device, hinges_),
      rate_(device, viscosity > 0 ? hinges_ : 0),
      viscous_(device, viscosity > 0 ? elements_ : 0),
      gradient_(device, 8 * static_cast<std::size_t>(hinges_)),
      moment_area_(device, static_cast<std::size_t>(elements_) * dimension_),
      force_(device, 4 * static_cast<std::size_t>(hinges_)),
      energy_(device, elements_) {
  const Adjacency a = vertex_hinges(mesh);
  vertex_start_ = Buffer<int, Device>(device, a.start);
  vertex_item_ = Buffer<int, Device>(device, a.item);
}

template <class Real, class Device>
OperatorView<Real> Bending<Real, Device>::view() const {
  const std::size_t bytes = element_bytes() + total_bytes(angle_);
  return {elements_,           area_.data(),      row_start_.data(), row_hinge_.data(),
          coefficient_.data(), direction_.data(), elastic_.data(),   bytes};
}

template <class Real, class Device>
void Bending<Real, Device>::commit(const Vec3<Real>* position, const Vec3<Real>* velocity, Real dt) {
  compute_angles(position, angle_.data(), angle_.data());
  if (viscosity_ > 0) compute_rates(velocity);
  law_->commit(device_, view(), angle_.data(), dt, {viscosity_, rate_.data(), viscous_.data()},
               moment_area_.data());
  compute_forces(position);
}

template <class Real, class Device>
void Bending<Real, Device>::compute_angles(const Vec3<Real>* x, const Real* previous, Real* change,
                                           AngleRates rates) {
  const Eigen::Vector4i* corner = corner_.data();
  const Real* rest = rest_angle_.data();
  Real* gradient = gradient_.data();
  const std::size_t read = total_bytes(corner_, rest_angle_, angle_) + vertex_bytes();
  const std::size_t rated = rates.rate ? total_bytes(rate_, reference_) : 0;
  for_each(
      device_, {"bending angles", read + rated + total_bytes(gradient_, angle_)}, hinges_,
      HYST_KERNEL(int h) {
        const Eigen::Vector4i c = corner[h];
        const Angle<Real> a = dihedral_angle<Real>(x[c[0]], x[c[1]], x[c[2]], x[c[3]]);
        const Real angle = continued_angle(a.theta, previous[h] + rest[h]) - rest[h];
        change[h] = angle;
        if (rates.rate) rates.rate[h] = rates.inverse_time * (angle - rates.reference[h]);
        Aligned<Real, 8>::of(gradient,
                             h) = {{a.g0[0], a.g0[1], a.g0[2], a.g1[0], a.g1[1], a.g1[2], a.t0, a.t1}};
      });
}

template <class Real, class Device>
void Bending<Real, Device>::compute_rates(const Vec3<Real>* v) {
  for_each(device_, {"bending rates", total_bytes(corner_, gradient_, rate_) + vertex_bytes()}, hinges_,
           HingeRates<Real>{corner_.data(), gradient_.data(), v, rate_.data()});
}

template <class Real, class Device>
void Bending<Real, Device>::compute_forces(const Vec3<Real>* x) {
  if (convention_ == ForceConvention::energy) return compute_energy_forces();
  const Eigen::Vector4i* corner = corner_.data();
  const Real *moment_area = moment_area_.data(), *area = area_.data();
  Vec3<Real>* force = force_.data();
  for_each(
      device_, "bending forces as printed", hinges_, HYST_KERNEL(int h) {
        const Eigen::Vector4i c = corner[h];
        chapter_forces<Real>(x[c[0]], x[c[1]], x[c[2]], x[c[3]], moment_area[h] / area[h], force + 4 * h);
      });
}

template <class Real, class Device>
void Bending<Real, Device>::compute_energy_forces() {
  dimension_ == 1 ? gather_torques<1>() : gather_torques<3>();
}

template <class Real, class Device>
template <int D>
void Bending<Real, Device>::gather_torques() {
  for_each(device_, {"bending forces", column_bytes() + total_bytes(moment_area_, gradient_, force_)},
           hinges_,
           HingeForces<Real, D>{column_start_.data(), column_element_.data(), transposed_.data(),
                                moment_area_.data(), gradient_.data(), force_.data()});
}

template <class Real, class Device>
void Bending<Real, Device>::command(CommandKind kind, const std::vector<char>& chosen) {
  if (taken_.size() == 0) taken_ = Buffer<double, Device>(device_, elements_);
  const Buffer<char, Device> mask(device_, chosen);
  law_->command(device_, view(), angle_.data(), kind, mask.data(), taken_.data());
}

template <class Real, class Device>
double Bending<Real, Device>::stored_energy() {
  law_->measure(device_, view(), angle_.data(), LawMeasure::stored_energy, energy_.data());
  return sum_over_elements(energy_.data());
}

template <class Real, class Device>
double Bending<Real, Device>::sum_over_elements(const double* on_device) {
  if (!on_device) return 0;
  std::vector<double> energy(elements_);
  device_download(device_, energy.data(), on_device, energy.size() * sizeof(double));
  return std::accumulate(energy.begin(), energy.end(), 0.0);
}

template <class Real, class Device>
std::vector<double> Bending<Real, Device>::geometric(std::vector<double> curvature) const {
  for (std::size_t i = 0; i < metric_.size(); ++i)
    curvature[i] = metric_[i] > 0 ? curvature[i] / metric_[i] : 0;
  return curvature;
}

template <class Real, class Device>
std::vector<double> Bending<Real, Device>::curvature() {
  Buffer<Real, Device> result(device_, static_cast<std::size_t>(elements_) * dimension_);
  const OperatorView<Real> op = view();
  const Real* angle = angle_.data();
  Real* k = result.data();
  if (dimension_ == 1) {
    for_each(
        device_, "curvature", elements_,
        HYST_KERNEL(int i) { k[i] = op.template curvature<1>(i, angle)[0]; });
  } else {
    for_each(
        device_, "curvature", elements_, HYST_KERNEL(int i) {
          const Vec<Real, 3> s = op.template curvature<3>(i, angle);
          for (int c = 0; c < 3; ++c) k[3 * i + c] = s[c];
        });
  }
  const std::vector<Real> values = result.download();
  return geometric({values.begin(), values.end()});
}

template <class Real, class Device>
std::vector<double> Bending<Real, Device>::moment() {
  std::vector<Real> values = moment_area_.download();
  const std::vector<Real> area = area_.download();
  for (std::size_t i = 0; i < values.size(); ++i) {
    values[i] /= area[i / dimension_];
    if (!metric_.empty()) values[i] *= static_cast<Real>(metric_[i]);
  }
  return {values.begin(), values.end()};
}

template <class Real, class Device>
std::vector<double> Bending<Real, Device>::measured(LawMeasure what, int numbers) {
  Buffer<double, Device> result(device_, static_cast<std::size_t>(elements_) * numbers);
  law_->measure(device_, view(), angle_.data(), what, result.data());
  return result.download();
}

template <class Real, class Device>
std::size_t Bending<Real, Device>::bytes() const {
  return total_bytes(area_, coefficient_, direction_, elastic_, transposed_, rest_angle_, row_start_,
                     row_hinge_, column_start_, column_element_, corner_, vertex_start_, vertex_item_, angle_,
                     rate_, viscous_, gradient_, moment_area_, force_, energy_, taken_, trial_angle_,
                     iterate_angle_, tangent_, hinge_stiffness_, reference_, angle_before_);
}

template class Bending<double, ThisDevice>;
template class Bending<float, ThisDevice>;

}  // namespace hysteron
