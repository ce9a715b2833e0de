// Contact in an implicit step.  Friction follows the normal force and therefore has no potential; with the
// force of the last iterate it has one, a stop's: k_t |e|^2/2 up to the limit, then limit |e|.
#include "sim/contact/sliding_stop.h"
#include "sim/contact/touch.h"

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
  const ContactModel<Real> model = model_;
  const ObstacleSet<Real> set = set_;
  const Real* area = area_.data();
  const Vec3<Real>* slipped = slip_.data();
  const int* touching = touching_.data();
  LaggedFriction<Real>* lagged = lagged_.data();
  for_each(
      device_, "contact friction, lagged", vertices_, HYST_KERNEL(int i) {
        const Touch<Real> t = touch(set, model, x[i], area[i]);
        lagged[i] = {t.normal, -t.obstacle_motion, t.friction * t.strongest};
        if (touching[i] == t.index + 1) lagged[i].start += slipped[i];
      });
  if (faces_) faces_->lag(set, x);
}

template <class Real, class Device>
void Contact<Real, Device>::evaluate(const Vec3<Real>* x, const Vec3<Real>* before, Vec3<Real>* gradient) {
  const ContactModel<Real> model = model_;
  const ObstacleSet<Real> set = set_;
  const Real* area = area_.data();
  const LaggedFriction<Real>* lagged = lagged_.data();
  double* energy = energy_.data();
  for_each(
      device_, "contact, tried", vertices_, HYST_KERNEL(int i) {
        const Touch<Real> t = touch(set, model, x[i], area[i]);
        energy[i] = t.energy;
        gradient[i] -= t.normal_force;
        if (!(lagged[i].limit > 0)) return;
        const Vec3<Real> e = lagged_slip<Real>(lagged[i], x[i] - before[i]);
        const Real k = model.stop_stiffness(lagged[i].limit, area[i]), length = e.norm(),
                   limit = lagged[i].limit / k;
        const bool slides = length > limit;
        energy[i] += static_cast<double>(k * (slides ? limit * (length - limit / 2) : length * length / 2));
        gradient[i] += (slides ? k * limit / length : k) * e;
      });
  if (faces_) faces_->evaluate(set, x, before, Real(-1), gradient, energy + vertices_);
}

template <class Real, class Device>
void Contact<Real, Device>::add_stiffness(const Vec3<Real>* x, const Vec3<Real>* before,
                                          BlockRowsView<Real> matrix, Real sliding_share) {
  const ContactModel<Real> model = model_;
  const ObstacleSet<Real> set = set_;
  const Real* area = area_.data();
  const LaggedFriction<Real>* lagged = lagged_.data();
  Mat3<Real>* diagonal = matrix.diagonal;
  for_each(
      device_, "contact stiffness", vertices_, HYST_KERNEL(int i) {
        diagonal[i] += touch(set, model, x[i], area[i]).normal_stiffness;
        if (!(lagged[i].limit > 0)) return;
        const Vec3<Real> e = lagged_slip<Real>(lagged[i], x[i] - before[i]);
        const Real k = model.stop_stiffness(lagged[i].limit, area[i]);
        diagonal[i] += sliding_stiffness<Real>(e, lagged[i].normal, k, lagged[i].limit / k, sliding_share);
      });
  if (faces_) faces_->add_stiffness(set, x, before, Real(1), matrix, sliding_share);
}

template class Contact<double, ThisDevice>;
template class Contact<float, ThisDevice>;

}  // namespace hysteron
