// Linear bending without memory: M = b2 K (Baraff & Witkin 1998, as E = k theta^2 / 2).
//
// On the tensor S it is the isotropic plate with Poisson's ratio 0: M = b2 S.
#pragma once

#include "sim/bending/law.h"

namespace hysteron {

template <class Real, int D>
struct Linear {
  static constexpr int kDimension = D;
  static constexpr int kHistory = 0;
  using Scalar = Real;

  Real b2 = 0;  // bending rigidity B [N m]

  static Linear make(const VirginCurve& curve) { return {Real(curve.b2)}; }

  HYST_HD LawStep<Real, D, 0> step(const Vec<Real, D>& curvature, const History<Real, 0>&) const {
    LawStep<Real, D, 0> result;
    result.moment = b2 * curvature;
    result.stored = b2 * curvature.squaredNorm() / 2;
    return result;
  }
  HYST_HD Tangent<Real, D> tangent(const Vec<Real, D>&, const History<Real, 0>&) const {
    return b2 * Tangent<Real, D>::Identity();
  }
  HYST_HD Vec<Real, D> residual(const History<Real, 0>&) const { return Vec<Real, D>::Zero(); }
  HYST_HD Real largest_stiffness() const { return b2; }
};

}  // namespace hysteron
