// The virgin curve without memory (Pabst et al. 2008; Breen et al. 1992 is its static drape).
//
//   M(K) = b1 K + c1 K^2   for 0 <= K <= K0,      M0 + b2 K   beyond,      odd in K      (Wong, Eq. 4.2)
//
// with K0 = (b2 - b1)/(2 c1), M0 = (b1 - b2) K0/2.  The chapter prints b1 <= b2; a stiffness that falls with
// curvature needs b1 >= b2.  On the tensor S the law is radial, M(|S|) S/|S|, which for a cylinder in any
// direction is the scalar law.  Source not had: Pabst's own fit to Clapp's cantilever profiles; the three
// numbers of the fabric stand for it.  K0 = 0 leaves M = b2 K.
#pragma once

#include "sim/bending/law.h"

namespace hysteron {

template <class Real, int D>
struct Pabst {
  static constexpr int kDimension = D;
  static constexpr int kHistory = 0;
  using Scalar = Real;

  Real b1 = 0;  // initial rigidity [N m]
  Real b2 = 0;  // rigidity of the straight branch [N m]
  Real c1 = 0;  // quadratic coefficient, <= 0 [N m^2]
  Real k0 = 0;  // elastic limit [1/m]
  Real m0 = 0;  // friction moment [N]

  static Pabst make(const VirginCurve& curve) {
    return {Real(curve.k0 > 0 ? curve.b1 : curve.b2), Real(curve.b2), Real(curve.c1()), Real(curve.k0),
            Real(curve.friction_moment())};
  }

  HYST_HD LawStep<Real, D, 0> step(const Vec<Real, D>& curvature, const History<Real, 0>&) const {
    const Real k = curvature.norm();
    LawStep<Real, D, 0> result;
    result.moment = secant(k) * curvature;
    result.stored = k <= k0 ? k * k * (b1 / 2 + c1 * k / 3) : b2 * k * k / 2 + m0 * (k - k0 / 3);
    return result;
  }
  HYST_HD Tangent<Real, D> tangent(const Vec<Real, D>& curvature, const History<Real, 0>&) const {
    const Real k = curvature.norm();
    Tangent<Real, D> result = secant(k) * Tangent<Real, D>::Identity();
    if (k > 0) result += secant_slope(k) / k * curvature * curvature.transpose();
    return result;
  }
  HYST_HD Vec<Real, D> residual(const History<Real, 0>&) const { return Vec<Real, D>::Zero(); }
  HYST_HD Real largest_stiffness() const { return b1; }

 private:
  HYST_HD Real secant(Real k) const { return k <= k0 ? b1 + c1 * k : b2 + m0 / k; }  // M/K [N m]
  HYST_HD Real secant_slope(Real k) const { return k <= k0 ? c1 : -m0 / (k * k); }   // d(M/K)/dK [N m^2]
};

}  // namespace hysteron
