// The signed dihedral angle of an interior edge and its gradient.
//
//              p0            u0 = p0 - p2, u1 = p1 - p2, e = p3 - p2
//             /  |           N0 = e x u0 (normal of face 0 times twice its area), N1 = u1 x e
//            /   |           theta = atan2(|e| N1.u0, N0.N1): zero when flat, positive where the front is
//            concave
//      p2 --e--> p3
//            \   |           t0, t1 = barycentric positions of p0, p1 along e (Wong, Leach, Zambetta
//            2013, 4.3.1)
//             \  |           d theta/d p0 = N0 |e|/|N0|^2,  d theta/d p1 = N1 |e|/|N1|^2
//              p1            d theta/d p2 = -(1-t0) g0 - (1-t1) g1,  d theta/d p3 = -t0 g0 - t1 g1
#pragma once

#include <cmath>

#include "sim/device/host_device.h"

namespace hysteron {

template <class Real>
struct Angle {
  Real theta;         // [rad], within (-pi, pi]
  Vec3<Real> g0, g1;  // gradients at the opposite corners [rad/m]
  Real t0, t1;        // barycentric positions of the opposite corners along the edge
  Real length;        // |e| [m]
};

template <class Real>
HYST_HD inline Angle<Real> dihedral_angle(const Vec3<Real>& p0, const Vec3<Real>& p1, const Vec3<Real>& p2,
                                          const Vec3<Real>& p3) {
  using std::atan2;
  using std::sqrt;
  const Vec3<Real> e = p3 - p2, u0 = p0 - p2, u1 = p1 - p2;
  const Vec3<Real> n0 = e.cross(u0), n1 = u1.cross(e);
  const Real ee = e.dot(e);
  Angle<Real> a;
  a.length = sqrt(ee);
  a.theta = atan2(a.length * n1.dot(u0), n0.dot(n1));
  a.g0 = n0 * (a.length / n0.squaredNorm());
  a.g1 = n1 * (a.length / n1.squaredNorm());
  a.t0 = e.dot(u0) / ee;
  a.t1 = e.dot(u1) / ee;
  return a;
}

// Returns d theta/d p [rad/m] of corner p0, p1, p2 or p3, from the eight numbers g0, g1, t0, t1.
template <class Real>
HYST_HD inline Vec3<Real> angle_gradient(const Real* g, int corner) {
  const Vec3<Real> g0(g[0], g[1], g[2]), g1(g[3], g[4], g[5]);
  if (corner == 0) return g0;
  if (corner == 1) return g1;
  const Vec3<Real> g3 = -(g[6] * g0 + g[7] * g1);
  return corner == 3 ? g3 : Vec3<Real>(-(g0 + g1 + g3));
}

// Returns the angle [rad] that differs from `previous` by less than pi and equals `theta` up to full turns: a
// hinge folded past flat-on-itself keeps turning instead of jumping by 2 pi.
template <class Real>
HYST_HD inline Real continued_angle(Real theta, Real previous) {
  using std::floor;
  const Real turn = Real(6.283185307179586476925);
  return theta + turn * floor((previous - theta) / turn + Real(0.5));
}

}  // namespace hysteron
