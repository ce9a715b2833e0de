// Plastic rest curvature above a yield curvature (O'Brien, Bargteil & Hodgins 2002, their strain thresholds
// gamma1, gamma2 read as curvatures; an angle threshold would depend on the mesh).
//
//   e = K - K_p;   if |e| > gamma1:  K_p += sgn(e) (|e| - gamma1);   then |K_p| <= gamma2;   M = b2 (K - K_p)
//
// gamma1 = `yield`, k0 by default; gamma2 = `max-set`, no bound by default.  Radial on the tensor
// while unbounded.
#pragma once

#include <cmath>

#include "sim/bending/laws/law_description.h"
#include "sim/bending/laws/plastic_return.h"

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
    const PlasticFlow<Real, D> flow = flow_to(curvature, before);
    LawStep<Real, D, D> result;
    result.moment = b2 * flow.elastic;
    result.stored = b2 * flow.elastic.squaredNorm() / 2;
    result.dissipated = b2 * yield * flow.moved;
    result.history = before;
    if (flow.moved > 0) store_set<Real, D>(flow.set, result.history);
    return result;
  }
  HYST_HD Tangent<Real, D> tangent(const Vec<Real, D>& curvature, const Memory& before) const {
    return b2 * flow_to(curvature, before).tangent;
  }
  HYST_HD Vec<Real, D> residual(const Memory& history) const { return load_set<Real, D>(history); }
  HYST_HD Real utilisation(const Vec<Real, D>& curvature, const Memory& history) const {  // returns |e|/y
    return yield > 0 ? (curvature - residual(history)).norm() / yield : Real(0);
  }
  HYST_HD Real largest_stiffness() const { return b2; }

 private:
  HYST_HD PlasticFlow<Real, D> flow_to(const Vec<Real, D>& curvature, const Memory& before) const {
    const Vec<Real, D> set = residual(before), trial = curvature - set;
    const Real n = trial.norm();
    return plastic_flow<Real, D>(trial, n, set, PlasticReturn<Real>::hardening(n, yield, 0), max_set);
  }
};

struct ObrienLaw {
  static constexpr const char* kName = "obrien";
  static constexpr const char* kMeaning =
      "plastic rest curvature above a yield curvature (O'Brien et al. 2002)";
  static constexpr LawFamily kFamily = LawFamily::plastic;
  static std::vector<LawParameter> parameters() { return {law_parameter::yield(), law_parameter::max_set()}; }
  // A bounded set has a scalar form only.
  static bool runs_along_directions(const LawParams& c) { return std::isfinite(c.max_set); }

  template <class Real, int D>
  static Obrien<Real, D> make(const LawParams& c) {
    return Obrien<Real, D>::make(c.curve, c.yield, c.max_set);
  }
};

}  // namespace hysteron
