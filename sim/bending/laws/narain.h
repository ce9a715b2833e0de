// Plasticity with weakening (Narain, Pfaff & O'Brien 2013, ARCSim, whose folding and crumpling sheets yield
// at 200/m with weakening 1 to 2).
//
//   as `obrien` with the yield curvature y;  M = b2/(1 + w d) (K - K_p);  when it yields: d += |e|/y - 1
//   (the way of K_p over y, also where K_p meets its bound)
//
// y = `yield`, k0 by default; w = `weakening`, 1 by default.  The damage d acts from the next step on, so
// that the moment of a step has a potential; the elastic energy that softening releases is booked as lost.
// Not convex once it acts within a step of its own.
#pragma once

#include <cmath>

#include "sim/bending/laws/law_description.h"
#include "sim/bending/laws/obrien.h"

namespace hysteron {

template <class Real, int D>
struct Narain {
  static constexpr int kDimension = D;
  static constexpr int kHistory = D + 1;  // K_p [1/m], damage
  using Scalar = Real;
  using Memory = History<Real, kHistory>;

  Obrien<Real, D> plastic;
  Real weakening = 1;  // w

  static Narain make(const VirginCurve& curve, double yield, double max_set, double weakening) {
    return {Obrien<Real, D>::make(curve, yield, max_set), Real(weakening)};
  }

  HYST_HD LawStep<Real, D, kHistory> step(const Vec<Real, D>& curvature, const Memory& before) const {
    const auto sound = plastic.step(curvature, history_of<Obrien<Real, D>>(before));
    const Vec<Real, D> set = load_set<Real, D>(sound.history);
    const Real stiff = stiffness(before[D]);
    LawStep<Real, D, kHistory> result;
    result.history = before;
    store_set<Real, D>(set, result.history);
    result.history[D] += (set - residual(before)).norm() / plastic.yield;
    const Real softer = stiffness(result.history[D]);
    result.moment = stiff * sound.moment;
    result.stored = softer * sound.stored;
    result.dissipated = stiff * sound.dissipated + (stiff - softer) * sound.stored;
    return result;
  }
  HYST_HD Tangent<Real, D> tangent(const Vec<Real, D>& curvature, const Memory& before) const {
    return stiffness(before[D]) * plastic.tangent(curvature, history_of<Obrien<Real, D>>(before));
  }
  HYST_HD Vec<Real, D> residual(const Memory& history) const { return load_set<Real, D>(history); }
  HYST_HD Real utilisation(const Vec<Real, D>& curvature, const Memory& history) const {  // returns |e|/y
    return plastic.utilisation(curvature, history_of<Obrien<Real, D>>(history));
  }
  HYST_HD Real largest_stiffness() const { return plastic.b2; }

 private:
  HYST_HD Real stiffness(Real damage) const { return 1 / (1 + weakening * damage); }
};

struct NarainLaw {
  static constexpr const char* kName = "narain";
  static constexpr const char* kMeaning = "plastic rest curvature with weakening (Narain et al. 2013)";
  static constexpr LawFamily kFamily = LawFamily::plastic;
  static std::vector<LawParameter> parameters() {
    return {law_parameter::yield(), law_parameter::max_set(), law_parameter::weakening()};
  }
  static void check(const LawParams& c, LawUse) {
    if (c.yield == 0) c.refuse("yield", "yield must be given and > 0 1/m where k0 is 0");
  }
  // A bounded set has a scalar form only.
  static bool runs_along_directions(const LawParams& c) { return std::isfinite(c.max_set); }

  template <class Real, int D>
  static Narain<Real, D> make(const LawParams& c) {
    return Narain<Real, D>::make(c.curve, c.yield, c.max_set, c.weakening);
  }
};

}  // namespace hysteron
