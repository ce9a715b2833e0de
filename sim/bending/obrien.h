// Plastic rest curvature above a yield curvature (O'Brien, Bargteil & Hodgins 2002, their strain thresholds
// gamma1, gamma2 read as curvatures; an angle threshold would depend on the mesh).
//
//   e = K - K_p;   if |e| > gamma1:  K_p += sgn(e) (|e| - gamma1);   then |K_p| <= gamma2;   M = b2 (K - K_p)
//
// gamma1 = `yield`, k0 by default; gamma2 = `max-set`, no bound by default.  Radial on the tensor.  Where the
// bound acts the tensor law has no potential (its tangent is not symmetric); a scalar curvature always has.
#pragma once

#include "sim/bending/plastic_return.h"

namespace hysteron {

template <class Real, int D>
struct Obrien {
  static constexpr int kDimension = D;
  static constexpr int kHistory = D;  // K_p [1/m]
  using Scalar = Real;
  using Memory = History<Real, D>;

  Real b2 = 0;       // rigidity [N m]
  Real yield = 0;    // gamma1 [1/m]
  Real max_set = 0;  // gamma2 [1/m]

  static Obrien make(const VirginCurve& curve, double yield, double max_set) {
    return {Real(curve.b2), Real(yield), Real(max_set)};
  }

  HYST_HD LawStep<Real, D, D> step(const Vec<Real, D>& curvature, const Memory& before) const {
    const Vec<Real, D> set = residual(before), trial = curvature - set;
    const Real n = trial.norm();
    LawStep<Real, D, D> result;
    result.history = before;
    Vec<Real, D> elastic = trial;
    if (n > yield) {
      const Vec<Real, D> along = trial / n, moved = bounded(set + (n - yield) * along);
      store_set<Real, D>(moved, result.history);
      elastic = curvature - moved;
      result.dissipated = b2 * yield * along.dot(moved - set);
    }
    result.moment = b2 * elastic;
    result.stored = b2 * elastic.squaredNorm() / 2;
    return result;
  }

  HYST_HD Tangent<Real, D> tangent(const Vec<Real, D>& curvature, const Memory& before) const {
    const Tangent<Real, D> one = Tangent<Real, D>::Identity();
    const Vec<Real, D> set = residual(before), trial = curvature - set;
    const Real n = trial.norm();
    if (!(n > yield)) return b2 * one;
    Tangent<Real, D> moves =
        one - PlasticReturn<Real>::hardening(n, yield, 0).template derivative<D>(trial, n);
    const Vec<Real, D> moved = set + (n - yield) / n * trial;
    const Real size = moved.norm();
    if (size > max_set) moves = max_set / size * (one - moved * moved.transpose() / (size * size)) * moves;
    return b2 * (one - moves);
  }
  HYST_HD Vec<Real, D> residual(const Memory& history) const { return load_set<Real, D>(history); }
  HYST_HD Real used(const Vec<Real, D>& curvature, const Memory& history) const {  // |e|/y
    return yield > 0 ? (curvature - residual(history)).norm() / yield : Real(0);
  }
  HYST_HD Real largest_stiffness() const { return b2; }

 private:
  HYST_HD Vec<Real, D> bounded(const Vec<Real, D>& set) const {
    const Real size = set.norm();
    return size > max_set ? Vec<Real, D>(max_set / size * set) : set;
  }
};

}  // namespace hysteron
