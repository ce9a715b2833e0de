// The virgin curve without memory (Pabst et al. 2008; Breen et al. 1992 is its static drape).
//
//   M(K) = b1 K + c1 K^2   for 0 <= K <= K0,      M0 + b2 K   beyond,      odd in K      (Wong, Eq. 4.2)
//
// with K0 = (b2 - b1)/(2 c1), M0 = (b1 - b2) K0/2.  The chapter prints b1 <= b2; a stiffness that falls with
// curvature needs b1 >= b2.  The source was not available: Pabst's own fit to Clapp's cantilever profiles;
// the three numbers of the fabric stand for it.  K0 = 0 leaves M = b2 K.
#pragma once

#include "sim/bending/laws/law_description.h"
#include "sim/bending/laws/radial_elastic.h"

namespace hysteron {

template <class Real, int D>
struct Pabst : RadialElastic<Pabst<Real, D>, Real, D> {
  Real b1 = 0;  // initial rigidity [N m]
  Real b2 = 0;  // rigidity of the straight branch [N m]
  Real c1 = 0;  // quadratic coefficient, <= 0 [N m^2]
  Real k0 = 0;  // elastic limit [1/m]
  Real m0 = 0;  // friction moment [N]

  static Pabst make(const VirginCurve& curve) {
    Pabst law;
    law.b1 = Real(curve.k0 > 0 ? curve.b1 : curve.b2);
    law.b2 = Real(curve.b2);
    law.c1 = Real(curve.c1());
    law.k0 = Real(curve.k0);
    law.m0 = Real(curve.friction_moment());
    return law;
  }

  HYST_HD Real secant(Real k) const { return k <= k0 ? b1 + c1 * k : b2 + m0 / k; }
  HYST_HD Real slope(Real k) const { return k <= k0 ? b1 + 2 * c1 * k : b2; }
  HYST_HD Real energy(Real k) const {
    return k <= k0 ? k * k * (b1 / 2 + c1 * k / 3) : b2 * k * k / 2 + m0 * (k - k0 / 3);
  }
  HYST_HD Real largest_stiffness() const { return b1; }
};

struct PabstLaw {
  static constexpr const char* kName = "pabst";
  static constexpr const char* kMeaning =
      "virgin curve without memory (Pabst et al. 2008, Breen et al. 1992)";
  static constexpr LawFamily kFamily = LawFamily::elastic;
  static constexpr bool kFrictionBesideB2 = true;

  template <class Real, int D>
  static Pabst<Real, D> make(const LawParams& c) {
    return Pabst<Real, D>::make(c.curve);
  }
};

}  // namespace hysteron
