#include "sim/contact/contact.h"

#include <numeric>

#include "sim/contact/obstacle_set.h"

namespace hysteron {

namespace {

// Most of the stiffness of friction's stop, over that of the shell at its stiffest.
constexpr double kTangential = 0.5;

template <class Real>
ContactModel<Real> contact_model(const Scene& scene) {
  const ObstacleShell<double> shell = obstacle_shell(scene);
  return {{static_cast<Real>(shell.thickness), static_cast<Real>(shell.k), static_cast<Real>(shell.last)},
          static_cast<Real>(kElasticSlip * shell.thickness),
          static_cast<Real>(kTangential * shell.stiffest())};
}

}  // namespace

template <class Real, class Device>
Contact<Real, Device>::Contact(Device& device, const ClothMesh& mesh, const Scene& scene)
    : device_(device),
      obstacle_(scene.obstacle),
      fabric_friction_(scene.fabric.friction),
      model_(contact_model<Real>(scene)),
      vertices_(mesh.vertices()),
      area_(device, std::vector<Real>(mesh.vertex_area.begin(), mesh.vertex_area.end())),
      stops_(device, vertices_, scene.integrator == Integrator::quasi_static ? vertices_ : 0),
      spared_(device, vertices_),
      energy_(device, 0),
      inside_(device, 1),
      share_(device),
      scratch_(device) {
  if (is_sharper_than_mesh(scene, mesh)) faces_.emplace(device, mesh, scene, model_);
  energy_ = Buffer<double, Device>(device, vertices_ + (faces_ ? faces_->faces() : 0));
}

template <class Real, class Device>
void Contact<Real, Device>::move(double start, double end) {
  set_ = obstacles_during<Real>(obstacle_, fabric_friction_, start, end);
  moved_from_ = start;
  moved_to_ = end;
}

template <class Real, class Device>
void Contact<Real, Device>::visit(Archive& archive) {
  archive(moved_from_);
  archive(moved_to_);
  if (archive.loads()) move(moved_from_, moved_to_);
  stops_.visit(archive, device_, spared_);
  if (faces_) faces_->visit(archive);
}

template <class Real, class Device>
void Contact<Real, Device>::add(const Vec3<Real>* x, const Vec3<Real>* before, Real step, Vec3<Real>* rhs,
                                const BlockRowsView<Real>* matrix) {
  Mat3<Real>* diagonal = matrix ? matrix->diagonal : nullptr;
  const VertexContact<Real> contact = view();
  const StopView<Real> stops = stops_.view();
  for_each(
      device_, "contact", vertices_, HYST_KERNEL(int i) {
        const Touch<Real> t = contact.touch_of(i, x);
        if (t.index < 0) return;
        const Slip<Real> s = contact.slip_of(i, t, x[i] - before[i], stops);
        const Real kt = s.stiffness * s.share;
        rhs[i] += step * (t.normal_force - kt * s.trial);
        if (!diagonal) return;
        diagonal[i] += step * step *
                       (t.normal_stiffness + kt * (Mat3<Real>::Identity() - t.normal * t.normal.transpose()));
      });
  if (faces_) faces_->add(set_, x, before, step, rhs, matrix);
}

template <class Real, class Device>
int Contact<Real, Device>::commit(const Vec3<Real>* x, const Vec3<Real>* before, const char* held) {
  const VertexContact<Real> contact = view();
  const StopView<Real> stops = stops_.view();
  double* inside = inside_.data();
  const char* spared = spared_.data();
  for_each_sum<1>(
      device_, "contact history", vertices_,
      HYST_KERNEL(int i, Sums<1>& sums) {
        const Touch<Real> t = contact.touch_of(i, x);
        if (stops.force) stops.work_before(i, i, motion_of(contact.set, stops.touching[i] - 1, x[i]));
        stops.touch(i, t.index);
        if (t.index < 0) return;
        if (t.inside && !(held[i] && spared[i])) sums.term[0] += 1;
        const Slip<Real> s = contact.slip_of(i, t, x[i] - before[i], stops);
        stops.work_after(i, i, t.normal_force - s.stiffness * stops.accept(i, s), t.obstacle_motion);
      },
      HYST_KERNEL(const Sums<1>& total) { *inside = total.term[0]; });
  return static_cast<int>(inside_.download()[0]) + (faces_ ? faces_->commit(set_, x, before, held) : 0);
}

template <class Real, class Device>
double Contact<Real, Device>::stored_energy(const Vec3<Real>* x) {
  const VertexContact<Real> contact = view();
  const double* stored = stops_.stored.data();
  double* energy = energy_.data();
  for_each(
      device_, "contact energy", vertices_,
      HYST_KERNEL(int i) { energy[i] = contact.touch_of(i, x).energy + stored[i]; });
  if (faces_) faces_->store_energies(set_, x, energy + vertices_);
  const std::vector<double> values = energy_.download();
  return std::accumulate(values.begin(), values.end(), 0.0);
}

template <class Real, class Device>
ContactLoss Contact<Real, Device>::losses() const {
  ContactLoss lost = stops_.losses();
  if (faces_) {
    const ContactLoss between = faces_->losses();
    lost.friction += between.friction;
    lost.obstacle_work += between.obstacle_work;
  }
  return lost;
}

template <class Real, class Device>
std::size_t Contact<Real, Device>::bytes() const {
  return bytes_of(area_, stops_, spared_, energy_, lagged_, inside_, share_, scratch_) +
         (faces_ ? faces_->bytes() : 0);
}

template class Contact<double, ThisDevice>;
template class Contact<float, ThisDevice>;

}  // namespace hysteron
