// Computes the stiffness of friction's stop, in contact with obstacles and between layers alike.
//
// Once the stop slides, its energy grows as limit |e| with the stretch e.  The second derivative of this,
// limit/|e| (P - e e'/|e|^2) with P the tangent plane's projection, has nothing along e: a direction of
// Newton's method runs past e = 0, where friction turns round, and most of it is cut off.  limit/|e| P is the
// stiffness of the quadratic that touches |e| and lies above it everywhere: with it full steps go down (Vogel
// & Oman 1996, lagged diffusivity), but near the minimum only linearly.  docs/contact.md has what was
// measured.
#pragma once

#include "sim/device/host_device.h"

namespace hysteron {

// Returns the stiffness of a stop of stiffness k [N/m] that slides from |e| = `most` on [m]; `fraction` of e
// e'/|e|^2 is taken out.
template <class Real>
HYST_HD Mat3<Real> sliding_stiffness(const Vec3<Real>& e, const Vec3<Real>& normal, Real k, Real most,
                                     Real fraction) {
  Mat3<Real> tangent = Mat3<Real>::Identity() - normal * normal.transpose();
  const Real length = e.norm();
  if (length > most) {
    tangent = most / length * (tangent - fraction * (e / length) * (e / length).transpose());
  }
  return k * tangent;
}

}  // namespace hysteron
