// Obstacles that vertices, or they themselves, would pass through in one step.
#include "sim/contact/contact.h"
#include "sim/contact/sweep.h"

namespace hysteron {

// The guess of a step: each vertex by itself, so that one does not hold up the others.
template <class Real, class Device>
void Contact<Real, Device>::keep_out(const Vec3<Real>* start, Vec3<Real>* end, const char* held) {
  if (!set_.has_thin()) return;
  const ObstacleSet<Real> set = set_;
  const Real rest = static_cast<Real>(1 - kCompressed) * model_.shell.thickness;  // where it is pressed back
  for_each(
      device_, "contact: guess", vertices_, HYST_KERNEL(int i) {
        if (!held[i]) end[i] = kept_out(set, start[i], end[i], rest);
      });
  if (faces_) faces_->keep_out(set, start, end, held, rest);
}

template <class Real, class Device>
bool Contact<Real, Device>::reaches(const Vec3<Real>* start, const Vec3<Real>* end, const char* held) {
  if (!set_.has_thin()) return true;
  const ObstacleSet<Real> set = set_;
  Real* share = share_.reserve(vertices_);
  for_each(
      device_, "contact: reached", vertices_, HYST_KERNEL(int i) {
        share[i] = held[i] || hysteron::reaches(set, start[i], end[i]) ? Real(1) : Real(0);
      });
  if (!(smallest(device_, scratch_, share, vertices_, Real(1)) > 0)) return false;
  return !faces_ || faces_->reaches(set, start, end, held);
}

// Where all go the same share of their way, as along a direction of Newton's method.
template <class Real, class Device>
double Contact<Real, Device>::feasible_step(const Vec3<Real>* x, const Vec3<Real>* direction,
                                            const char* held, double max_step) {
  if (!set_.has_thin()) return max_step;
  const ObstacleSet<Real> set = set_;
  const Real asked = static_cast<Real>(max_step);
  Real* share = share_.reserve(vertices_);
  for_each(
      device_, "contact: collisions", vertices_, HYST_KERNEL(int i) {
        share[i] = 1;
        if (held[i]) return;
        const Vec3<Real> way = asked * direction[i];
        for (int o = 0; o < set.count; ++o) {
          if (!set.item[o].is_thin()) continue;
          const Real free = free_share(set.item[o], x[i], way);
          share[i] = free < share[i] ? free : share[i];
        }
      });
  const double free = max_step * static_cast<double>(smallest(device_, scratch_, share, vertices_, Real(1)));
  return faces_ ? faces_->feasible_step(set, x, direction, held, free) : free;
}

template class Contact<double, ThisDevice>;
template class Contact<float, ThisDevice>;

}  // namespace hysteron
