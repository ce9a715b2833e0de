// Elastic bending that softens exponentially: the virgin curve of `dahl` without its memory.
//
//   M = b2 K + M0 (1 - exp(-K/l)),   l = softness K0,   odd in K
//
// softness = 1/2 by default, which makes b1 the first slope.  K0 = 0 or b1 = b2 leave M = b2 K.
#pragma once

#include <cmath>

#include "sim/bending/laws/law_description.h"
#include "sim/bending/laws/radial_elastic.h"

namespace hysteron {

template <class Real, int D>
struct Exponential : RadialElastic<Exponential<Real, D>, Real, D> {
  Real b2 = 0;  // rigidity far beyond l [N m]
  Real m0 = 0;  // moment by which the straight line misses the origin [N]
  Real l = 1;   // curvature over which bending softens [1/m]

  static Exponential make(const VirginCurve& curve, double softness) {
    Exponential law;
    law.b2 = Real(curve.b2);
    if (curve.friction_moment() > 0) {
      law.m0 = Real(curve.friction_moment());
      law.l = Real(softness * curve.k0);
    }
    return law;
  }

  HYST_HD Real secant(Real k) const { return k > 0 ? b2 + m0 * softened(k) / k : slope(k); }
  HYST_HD Real slope(Real k) const {
    using std::exp;
    return b2 + m0 / l * exp(-k / l);
  }
  HYST_HD Real energy(Real k) const { return b2 * k * k / 2 + m0 * (k - l * softened(k)); }
  HYST_HD Real largest_stiffness() const { return b2 + m0 / l; }

 private:
  HYST_HD Real softened(Real k) const {  // 1 - exp(-k/l)
    using std::expm1;
    return -expm1(-k / l);
  }
};

struct ExponentialLaw {
  static constexpr const char* kName = "exponential";
  static constexpr const char* kMeaning = "softens exponentially from b1 to b2, no memory (an example)";
  static constexpr LawFamily kFamily = LawFamily::elastic;
  static std::vector<LawParameter> parameters() {
    return {{"softness", [](const ParameterText& t, LawParams& c) { c.own["softness"] = t.positive(""); }}};
  }

  template <class Real, int D>
  static Exponential<Real, D> make(const LawParams& c) {
    return Exponential<Real, D>::make(c.curve, c.own_or("softness", 0.5));
  }
};

}  // namespace hysteron
