// Creeping rest curvature with loss of stiffness (after Kim et al. 2011, persistent wrinkles; their ten
// parameters were not available, and the four here are ours).
//
//   e = K - K_p;  while |e| > y:  dK_p/dt = e/tau;   M = b2/(1 + w d) e;   d += |dK_p|/y
//
// y = `yield`, k0 by default; tau = 1 s; w = `weakening` = 1; |K_p| <= `max-set`, no bound by default.  Over
// a step at its final curvature e decays by exp(-dt/tau), down to y, exactly.  The damage acts from the next
// step on; the energy that softening releases is booked as lost.  Radial on the tensor.
#pragma once

#include <cmath>

#include "sim/bending/plastic_return.h"

namespace hysteron {

template <class Real, int D>
struct Kim {
  static constexpr int kDimension = D;
  static constexpr int kHistory = D + 1;  // K_p [1/m], damage
  using Scalar = Real;
  using Memory = History<Real, kHistory>;

  Real b2 = 0;         // rigidity [N m]
  Real yield = 0;      // y [1/m]
  Real max_set = 0;    // [1/m]
  Real weakening = 1;  // w
  Real tau = 1;        // time of creep [s]
  Real dt = 0;         // time of the step [s]

  static Kim make(const VirginCurve& curve, double yield, double max_set, double weakening, double tau) {
    return {Real(curve.b2), Real(yield), Real(max_set), Real(weakening), Real(tau), 0};
  }

  HYST_HD LawStep<Real, D, kHistory> step(const Vec<Real, D>& curvature, const Memory& before) const {
    const Vec<Real, D> set = residual(before), trial = curvature - set;
    const Real n = trial.norm(), stiff = stiffness(before[D]);
    const PlasticReturn<Real> now = returned(n, set, trial);
    LawStep<Real, D, kHistory> result;
    result.history = before;
    Vec<Real, D> elastic = trial;
    if (n > now.held) {
      elastic = now.held / n * trial;
      store_set<Real, D>(curvature - elastic, result.history);
      result.history[D] += (n - now.held) / yield;
    }
    const Real softer = stiffness(result.history[D]), half = elastic.squaredNorm() / 2;
    result.moment = stiff * elastic;
    result.stored = softer * half;
    result.dissipated = stiff * now.lost + (stiff - softer) * half;
    return result;
  }
  HYST_HD Tangent<Real, D> tangent(const Vec<Real, D>& curvature, const Memory& before) const {
    const Vec<Real, D> set = residual(before), trial = curvature - set;
    const Real n = trial.norm();
    return stiffness(before[D]) * returned(n, set, trial).template derivative<D>(trial, n);
  }
  HYST_HD Vec<Real, D> residual(const Memory& history) const { return load_set<Real, D>(history); }
  HYST_HD Real used(const Vec<Real, D>& curvature, const Memory& history) const {  // |e|/y
    return yield > 0 ? (curvature - residual(history)).norm() / yield : Real(0);
  }
  HYST_HD Real largest_stiffness() const { return b2; }

 private:
  HYST_HD Real stiffness(Real damage) const { return b2 / (1 + weakening * damage); }
  // The set moves along the trial stretch, and no further than its bound allows: beyond that the law is
  // elastic.
  HYST_HD PlasticReturn<Real> returned(Real n, const Vec<Real, D>& set, const Vec<Real, D>& trial) const {
    using std::exp;
    using std::sqrt;
    const Real f = exp(-dt / tau);
    const PlasticReturn<Real> free = PlasticReturn<Real>::relaxing(n, yield, f);
    if (!(n > free.held)) return free;
    const Real along = set.dot(trial) / n;
    const Real room = -along + sqrt(along * along + max_set * max_set - set.squaredNorm());
    if (!(n - free.held > room)) return free;
    const Real last = room + yield > room / (1 - f) ? room + yield : room / (1 - f);
    return {n - room, 1, PlasticReturn<Real>::relaxing(last, yield, f).lost};
  }
};

}  // namespace hysteron
