// One stop at K0 beside b2 (Anandjiwala & Leaf 1991; Wong, Fig. 4.4a): slope Ma/K0 up to the elastic limit,
// b2 beyond, the first slope again over 2 K0 after each reversal.  Owen 1968 and Chapman 1975 are its limit
// K0 -> 0.
#pragma once

#include "sim/bending/laws/law_description.h"
#include "sim/bending/laws/prandtl_stops.h"

namespace hysteron {

template <class Real, int D>
PrandtlStops<Real, D, 1> make_bilinear(const VirginCurve& curve) {
  PrandtlStops<Real, D, 1> law = PrandtlStops<Real, D, 1>::make(curve);
  if (curve.k0 > 0) {
    law.p[0] = Real(curve.friction_moment() / curve.k0);
    law.limit[0] = Real(curve.k0);
  }
  return law;
}

struct BilinearLaw {
  static constexpr const char* kName = "bilinear";
  static constexpr const char* kMeaning = "one stop at K0 beside b2 (Anandjiwala & Leaf 1991)";
  static constexpr LawFamily kFamily = LawFamily::hysteretic;
  static constexpr bool kFrictionBesideB2 = true;
  static std::vector<LawParameter> parameters() { return law_parameter::with_fatigue({}); }

  template <class Real, int D>
  static PrandtlStops<Real, D, 1> make(const LawParams& c) {
    return make_bilinear<Real, D>(c.curve);
  }
};

}  // namespace hysteron
