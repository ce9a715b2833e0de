// The rest curvature creeps and stiffness is lost (after Kim et al. 2011, persistent wrinkles; their ten
// parameters were not available, and the four here are ours).
//
//   e = K - K_p;  while |e| > y:  dK_p/dt = e/tau;   M = b2/(1 + w d) e;   d += |dK_p|/y
//
// y = `yield`, k0 by default; tau = 1 s; w = `weakening` = 1; |K_p| <= `max-set`, no bound by default.  Over
// a step at its final curvature e decays by exp(-dt/tau), down to y, exactly.  The damage acts from the next
// step on; the energy that softening releases is booked as lost.  Radial on the tensor.
#pragma once

#include <cmath>

#include "sim/bending/laws/law_description.h"
#include "sim/bending/laws/plastic_return.h"

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
    const PlasticFlow<Real, D> flow = flow_to(curvature, before);
    const Real stiff = stiffness(before[D]), half = flow.elastic.squaredNorm() / 2;
    LawStep<Real, D, kHistory> result;
    result.history = before;
    if (flow.moved > 0) {
      store_set<Real, D>(flow.set, result.history);
      result.history[D] += flow.moved / yield;
    }
    const Real softer = stiffness(result.history[D]),
               trial = (curvature - residual(before)).squaredNorm() / 2;
    result.moment = stiff * flow.elastic;
    result.stored = softer * half;
    result.dissipated = stiff * trial - softer * half;
    return result;
  }
  HYST_HD Tangent<Real, D> tangent(const Vec<Real, D>& curvature, const Memory& before) const {
    return stiffness(before[D]) * flow_to(curvature, before).tangent;
  }
  // Integrates the held stretch over the trial one: it is n below y, y up to y/f, then f n, and again n -
  // moved where the set meets its bound.
  HYST_HD Real potential(const Vec<Real, D>& curvature, const Memory& before) const {
    using std::exp;
    const Vec<Real, D> set = residual(before), trial = curvature - set;
    const Real n = trial.norm(), f = exp(-dt / tau);
    Real end = n;
    if constexpr (D == 1) {
      const Real room = max_set - (trial[0] < 0 ? -set[0] : set[0]);
      const Real meets = f * (yield + room) > yield ? room / (1 - f) : yield + room;
      if (meets < n) end = meets > 0 ? meets : Real(0);
    }
    Real sum = (end < yield ? end : yield) * (end < yield ? end : yield) / 2;
    if (end > yield) sum += yield * ((f * end > yield ? yield / f : end) - yield);
    if (f * end > yield) sum += (f * end * end - yield * yield / f) / 2;
    const Real moved = end - PlasticReturn<Real>::relaxing(end, yield, f).held;
    sum += ((n - moved) * (n - moved) - (end - moved) * (end - moved)) / 2;
    return stiffness(before[D]) * sum;
  }
  HYST_HD Vec<Real, D> residual(const Memory& history) const { return load_set<Real, D>(history); }
  HYST_HD Real utilisation(const Vec<Real, D>& curvature, const Memory& history) const {  // returns |e|/y
    return yield > 0 ? (curvature - residual(history)).norm() / yield : Real(0);
  }
  HYST_HD Real largest_stiffness() const { return b2; }

 private:
  HYST_HD Real stiffness(Real damage) const { return b2 / (1 + weakening * damage); }
  HYST_HD PlasticFlow<Real, D> flow_to(const Vec<Real, D>& curvature, const Memory& before) const {
    using std::exp;
    const Vec<Real, D> set = residual(before), trial = curvature - set;
    const Real n = trial.norm();
    return plastic_flow<Real, D>(trial, n, set, PlasticReturn<Real>::relaxing(n, yield, exp(-dt / tau)),
                                 max_set);
  }
};

struct KimLaw {
  static constexpr const char* kName = "kim";
  static constexpr const char* kMeaning =
      "rest curvature creeps above a threshold, with loss of stiffness (Kim et al. 2011)";
  static constexpr LawFamily kFamily = LawFamily::plastic;
  static std::vector<LawParameter> parameters() {
    return {law_parameter::yield(), law_parameter::max_set(), law_parameter::weakening(),
            law_parameter::tau()};
  }
  static void check(const LawParams& c, LawUse) {
    if (c.yield == 0) c.refuse("yield", "yield must be given and > 0 1/m where k0 is 0");
  }
  // A bounded set has a scalar form only.
  static bool runs_along_directions(const LawParams& c) { return std::isfinite(c.max_set); }

  template <class Real, int D>
  static Kim<Real, D> make(const LawParams& c) {
    return Kim<Real, D>::make(c.curve, c.yield, c.max_set, c.weakening, c.tau);
  }
};

}  // namespace hysteron
