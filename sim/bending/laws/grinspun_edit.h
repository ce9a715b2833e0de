// Elastic bending whose rest curvature is set to the current one on command (after Grinspun et al. 2003, who
// model creases and curls of thin shells by editing rest angles).
//
//   M = b2 (K - K_r),   on command: K_r = K
//
// The command is the user's, not the material's: the energy that it removes is booked apart from friction.
#pragma once

#include "sim/bending/laws/law_description.h"

namespace hysteron {

template <class Real, int D>
struct GrinspunEdit {
  static constexpr int kDimension = D;
  static constexpr int kHistory = D;  // K_r [1/m]
  using Scalar = Real;
  using Memory = History<Real, D>;

  Real b2 = 0;  // bending rigidity [N m]

  static GrinspunEdit make(const VirginCurve& curve) { return {Real(curve.b2)}; }

  HYST_HD LawStep<Real, D, D> step(const Vec<Real, D>& curvature, const Memory& before) const {
    const Vec<Real, D> bent = curvature - residual(before);
    LawStep<Real, D, D> result;
    result.moment = b2 * bent;
    result.stored = b2 * bent.squaredNorm() / 2;
    result.history = before;
    return result;
  }
  HYST_HD Tangent<Real, D> tangent(const Vec<Real, D>&, const Memory&) const {
    return b2 * Tangent<Real, D>::Identity();
  }
  // Returns the history after the command at this curvature.
  HYST_HD Memory edited(const Vec<Real, D>& curvature, const Memory&) const {
    Memory after;
    store_set<Real, D>(curvature, after);
    return after;
  }
  HYST_HD Vec<Real, D> residual(const Memory& history) const { return load_set<Real, D>(history); }
  HYST_HD Real utilisation(const Vec<Real, D>&, const Memory&) const { return 0; }
  HYST_HD Real largest_stiffness() const { return b2; }
};

struct GrinspunEditLaw {
  static constexpr const char* kName = "grinspun-edit";
  static constexpr const char* kMeaning = "rest curvature set on command (Grinspun et al. 2003)";
  static constexpr LawFamily kFamily = LawFamily::plastic;

  template <class Real, int D>
  static GrinspunEdit<Real, D> make(const LawParams& c) {
    return GrinspunEdit<Real, D>::make(c.curve);
  }
};

}  // namespace hysteron
