// Linear bending without memory: M = b2 K.
//
// On the tensor S it is the isotropic plate with Poisson's ratio 0.  Others' constants for a hinge follow,
// with edge length |e| and heights h0, h1, and mean h = (h0 + h1)/2: Baraff & Witkin 1998, E = k theta^2/2,
// has k = b2 |e|/h; Grinspun et al. 2003, E = k theta^2 |e|/(h/3), has k = b2/6.
#pragma once

#include "sim/bending/laws/law_description.h"
#include "sim/bending/laws/radial_elastic.h"

namespace hysteron {

template <class Real, int D>
struct Linear : RadialElastic<Linear<Real, D>, Real, D> {
  Real b2 = 0;  // bending rigidity B [N m]

  explicit Linear(Real rigidity = 0) : b2(rigidity) {}
  static Linear make(const VirginCurve& curve) { return Linear(Real(curve.b2)); }

  HYST_HD Real secant(Real) const { return b2; }
  HYST_HD Real slope(Real) const { return b2; }
  HYST_HD Real energy(Real k) const { return b2 * k * k / 2; }
  HYST_HD Real largest_stiffness() const { return b2; }
};

struct LinearLaw {
  static constexpr const char* kName = "linear";
  static constexpr const char* kMeaning = "M = b2 K, no memory (Baraff & Witkin 1998)";
  static constexpr LawFamily kFamily = LawFamily::elastic;
  static constexpr bool kHasFaces = true;

  template <class Real, int D>
  static Linear<Real, D> make(const LawParams& c) {
    return Linear<Real, D>::make(c.curve);
  }
};

}  // namespace hysteron
