// The barrier between two layers of cloth exerts no force at the activation distance, and one that grows
// without bound as the gap (the distance less that of the hardest compression) becomes small against its
// range.  Where hardly any gap is left, the force goes on growing with constant stiffness: a step that does
// not end in equilibrium must not leave a pair so near that nothing can move any more.
//
// Source: Li, Ferguson, Schneider, Langlois, Zorin, Panozzo, Jiang & Kaufman 2020 (Incremental Potential
// Contact), eq. 6 and, for nearly parallel edges, eq. 24.
#pragma once

#include <cmath>

#include "sim/device/host_device.h"

namespace hysteron {

template <class Real>
struct Barrier {
  Real energy, slope, stiffness;  // [J/m^2], by distance [N/m^2], [N/m^3]; slope <= 0 <= stiffness
};

template <class Real>
HYST_HD Barrier<Real> operator+(const Barrier<Real>& a, const Barrier<Real>& b) {
  return {a.energy + b.energy, a.slope + b.slope, a.stiffness + b.stiffness};
}

inline constexpr double kStiffest = 0.05;

// Returns the barrier of a gap [m] below the range [m], with k [N/m^3].  The stiffness stays constant below
// `stiffest` times the range.
template <class Real>
HYST_HD Barrier<Real> barrier(Real k, Real gap, Real range, Real stiffest = static_cast<Real>(kStiffest)) {
  using std::log;
  const Real closest = stiffest * range, beyond = gap < closest ? gap - closest : Real(0);
  const Real u = (gap - beyond) / range, w = u - 1, ln = log(u);
  const Real energy = -k * range * range * w * w * ln, slope = -k * range * (2 * w * ln + w * w / u),
             stiffness = k * (w * w / (u * u) - 4 * w / u - 2 * ln);
  return {energy + beyond * (slope + beyond * stiffness / 2), slope + beyond * stiffness, stiffness};
}

// Fades the energy of two edges out as they become parallel, where their closest points jump. c is the
// squared norm of the edges' cross product [m^4]; the factor is 1 from `full` on.
template <class Real>
struct Fade {
  Real factor, slope;  // factor, and its derivative by c [1/m^4]
};
template <class Real>
HYST_HD Fade<Real> parallel_fade(Real c, Real full) {
  if (c >= full) return {1, 0};
  const Real s = c / full;
  return {s * (2 - s), 2 * (1 - s) / full};
}

}  // namespace hysteron
