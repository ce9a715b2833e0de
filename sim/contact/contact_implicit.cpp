// Contact in an implicit step.  Friction follows the normal force and therefore has no potential; with the
// force of the last iterate it has one, a stop's: k_t |e|^2/2 up to the limit, then limit |e|.
#include "sim/contact/contact.h"

namespace hysteron {
namespace {

// Stretch of the tangential stop at `moved` = x - before.
template <class Real>
HYST_HD Vec3<Real> lagged_slip(const LaggedFriction<Real>& lagged, const Vec3<Real>& moved) {
  const Vec3<Real> e = moved + lagged.start;
  return e - lagged.normal * lagged.normal.dot(e);
}

}  // namespace

template <class Real, class Device>
void Contact<Real, Device>::lag(const Vec3<Real>* x) {
  if (lagged_.size() == 0) lagged_ = Buffer<LaggedFriction<Real>, Device>(device_, vertices_);
  const VertexContact<Real> contact = view();
  const StopView<Real> stops = stops_.view();
  LaggedFriction<Real>* lagged = lagged_.data();
  for_each(
      device_, "contact friction, lagged", vertices_, HYST_KERNEL(int i) {
        const Touch<Real> t = contact.touch_of(i, x);
        lagged[i] = {t.normal, -t.obstacle_motion, t.friction * t.strongest};
        if (stops.touching[i] == t.index + 1) lagged[i].start += stops.slip[i];
      });
  if (faces_) faces_->lag(set_, x);
}

template <class Real, class Device>
void Contact<Real, Device>::evaluate(const Vec3<Real>* x, const Vec3<Real>* before, Vec3<Real>* gradient) {
  const VertexContact<Real> contact = view();
  const LaggedFriction<Real>* lagged = lagged_.data();
  double* energy = energy_.data();
  for_each(
      device_, "contact, tried", vertices_, HYST_KERNEL(int i) {
        const Touch<Real> t = contact.touch_of(i, x);
        energy[i] = t.energy;
        gradient[i] -= t.normal_force;
        if (!(lagged[i].limit > 0)) return;
        const Real k = contact.model.stop_stiffness(lagged[i].limit, contact.area[i]);
        Vec3<Real> back;
        energy[i] += lagged[i].energy_at(lagged_slip<Real>(lagged[i], x[i] - before[i]), k, back);
        gradient[i] += back;
      });
  if (faces_) faces_->evaluate(set_, x, before, Real(-1), gradient, energy + vertices_);
}

template <class Real, class Device>
void Contact<Real, Device>::add_stiffness(const Vec3<Real>* x, const Vec3<Real>* before,
                                          BlockRowsView<Real> matrix, Real sliding_share) {
  const VertexContact<Real> contact = view();
  const LaggedFriction<Real>* lagged = lagged_.data();
  Mat3<Real>* diagonal = matrix.diagonal;
  for_each(
      device_, "contact stiffness", vertices_, HYST_KERNEL(int i) {
        diagonal[i] += contact.touch_of(i, x).normal_stiffness;
        if (!(lagged[i].limit > 0)) return;
        const Real k = contact.model.stop_stiffness(lagged[i].limit, contact.area[i]);
        diagonal[i] +=
            lagged[i].stiffness_at(lagged_slip<Real>(lagged[i], x[i] - before[i]), k, sliding_share);
      });
  if (faces_) faces_->add_stiffness(set_, x, before, Real(1), matrix, sliding_share);
}

template class Contact<double, ThisDevice>;
template class Contact<float, ThisDevice>;

}  // namespace hysteron
