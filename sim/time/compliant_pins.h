// A pin of limited strength pulls its vertices towards their positions on it: a spring gives by give =
// `yield_distance` under the vertex's share of the strength, and beyond that pulls with just this share.  The
// energy of a vertex that lags by r is
//
//   strength r^2/(2 give)  for r <= give,  strength (r - give/2)  beyond,
//
// and the pin's work is that of an outer force.  Its vertices are free: contact keeps them apart like any
// others, so that every motion of the pin is possible.
#pragma once

#include "sim/contact/sliding_stop.h"
#include "sim/device/host_device.h"

namespace hysteron {

// Holds arrays of n vertices; travels with a kernel launch by value.
template <class Real>
struct CompliantPins {
  const Vec3<Real>* target = nullptr;  // where the pins are at the end of the stage [m]
  // Each vertex's share [N], 0 where no pin holds it; null: no pin is compliant.
  const Real* strength = nullptr;
  Real yield_distance = 0;  // [m]

  HYST_HD bool any_at(int i) const { return strength && strength[i] > 0; }
  HYST_HD Real lag(int i, const Vec3<Real>& x) const { return any_at(i) ? (x - target[i]).norm() : Real(0); }
  // Returns the force on the vertex [N].
  HYST_HD Vec3<Real> force(int i, const Vec3<Real>& x) const {
    if (!any_at(i)) return Vec3<Real>::Zero();
    const Vec3<Real> displacement = target[i] - x;
    const Real r = displacement.norm();
    return strength[i] / (r > yield_distance ? r : yield_distance) * displacement;
  }
  HYST_HD Real energy(int i, const Vec3<Real>& x) const {  // [J]
    if (!any_at(i)) return 0;
    const Real r = (x - target[i]).norm();
    return strength[i] * (r > yield_distance ? r - yield_distance / 2 : r * r / (2 * yield_distance));
  }
  // Returns the stiffness, formed like that of sliding friction (sliding_stop.h) [N/m].
  HYST_HD Mat3<Real> stiffness(int i, const Vec3<Real>& x, Real fraction) const {
    if (!any_at(i)) return Mat3<Real>::Zero();
    return sliding_stiffness<Real>(x - target[i], Vec3<Real>::Zero(), strength[i] / yield_distance,
                                   yield_distance, fraction);
  }
};

}  // namespace hysteron
