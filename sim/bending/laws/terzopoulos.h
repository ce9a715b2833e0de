// The rest curvature is viscoplastic (after Terzopoulos & Fleischer 1988, whose inelastic models creep above
// a yield limit; this form is ours).
//
//   M = b2 (K - K_p),   dK_p/dt = sgn(M) (|M| - M0)+ / (b2 tau),   tau = 1 s by default
//
// Over a step of length dt at its final curvature the excess over M0 decays by exp(-dt/tau), exactly.  Radial
// on the tensor.  Not taken from the source: its constants, which are per material and not for bending.
#pragma once

#include <cmath>

#include "sim/bending/laws/law_description.h"
#include "sim/bending/laws/plastic_return.h"

namespace hysteron {

template <class Real, int D>
struct Terzopoulos {
  static constexpr int kDimension = D;
  static constexpr int kHistory = D;  // K_p [1/m]
  using Scalar = Real;
  using Memory = History<Real, D>;

  Real b2 = 0;     // rigidity [N m]
  Real yield = 0;  // M0/b2 [1/m]
  Real tau = 1;    // time of creep [s]
  Real dt = 0;     // time of the step [s]

  static Terzopoulos make(const VirginCurve& curve, double tau) {
    return {Real(curve.b2), Real(curve.b2 > 0 ? curve.friction_moment() / curve.b2 : 0), Real(tau), 0};
  }

  HYST_HD LawStep<Real, D, D> step(const Vec<Real, D>& curvature, const Memory& before) const {
    const Vec<Real, D> trial = curvature - residual(before);
    const Real n = trial.norm();
    const PlasticReturn<Real> now = returned(n);
    const Vec<Real, D> elastic = n > now.held ? Vec<Real, D>(now.held / n * trial) : trial;
    LawStep<Real, D, D> result;
    result.moment = b2 * elastic;
    result.stored = b2 * now.held * now.held / 2;
    result.dissipated = b2 * now.lost_by_creep(n);
    result.history = before;
    if (n > now.held) store_set<Real, D>(curvature - elastic, result.history);
    return result;
  }
  HYST_HD Tangent<Real, D> tangent(const Vec<Real, D>& curvature, const Memory& before) const {
    const Vec<Real, D> trial = curvature - residual(before);
    const Real n = trial.norm();
    return b2 *
           plastic_flow<Real, D>(trial, n, Vec<Real, D>::Zero(), returned(n), 2 * n).tangent;  // no bound
  }
  // A longer trial stretch creeps to a longer held one: the moment follows `held`, whatever is lost.
  HYST_HD Real potential(const Vec<Real, D>& curvature, const Memory& before) const {
    const Real n = (curvature - residual(before)).norm();
    const PlasticReturn<Real> now = returned(n);
    return b2 * (now.held * now.held / 2 + now.lost_by_yielding(n, yield < n ? yield : n));
  }
  HYST_HD Vec<Real, D> residual(const Memory& history) const { return load_set<Real, D>(history); }
  HYST_HD Real utilisation(const Vec<Real, D>& curvature, const Memory& history) const {  // returns |e|/y
    return yield > 0 ? (curvature - residual(history)).norm() / yield : Real(0);
  }
  HYST_HD Real largest_stiffness() const { return b2; }

 private:
  HYST_HD PlasticReturn<Real> returned(Real n) const {
    using std::exp;
    return PlasticReturn<Real>::hardening(n, yield, exp(-dt / tau));
  }
};

struct TerzopoulosLaw {
  static constexpr const char* kName = "terzopoulos";
  static constexpr const char* kMeaning =
      "viscoplastic rest curvature above a yield moment (Terzopoulos & Fleischer 1988)";
  static constexpr LawFamily kFamily = LawFamily::plastic;
  static std::vector<LawParameter> parameters() { return {law_parameter::tau()}; }

  template <class Real, int D>
  static Terzopoulos<Real, D> make(const LawParams& c) {
    return Terzopoulos<Real, D>::make(c.curve, c.tau);
  }
};

}  // namespace hysteron
