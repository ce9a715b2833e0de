// Bending elements of Bridson, Marino & Fedkiw 2003: a force k |E|^2/(|N1| + |N2|) sin(theta/2).
//
// For a hinge of mean height h and K = theta/h this is the moment per width
//   M = (2 b2/h) sin(K h/2),   slope b2 at K = 0,
// which vanishes again when the cloth is folded by 360 degrees and softens from the start: its energy is not
// convex beyond 180 degrees.  h is a parameter here, not the mesh's, so that the law is the same on any mesh.
#pragma once

#include <cmath>

#include "sim/bending/laws/law_description.h"
#include "sim/bending/laws/radial_elastic.h"

namespace hysteron {

template <class Real, int D>
struct Bridson : RadialElastic<Bridson<Real, D>, Real, D> {
  Real b2 = 0;  // rigidity at small bends [N m]
  Real h = 0;   // height of the hinge [m]

  static Bridson make(const VirginCurve& curve, double height) {
    Bridson law;
    law.b2 = Real(curve.b2);
    law.h = Real(height);
    return law;
  }

  HYST_HD Real secant(Real k) const {
    using std::sin;
    const Real x = k * h / 2;
    return x > 0 ? b2 * sin(x) / x : b2;
  }
  HYST_HD Real slope(Real k) const {
    using std::cos;
    return b2 * cos(k * h / 2);
  }
  HYST_HD Real energy(Real k) const {
    using std::sin;
    const Real s = sin(k * h / 4);
    return 8 * b2 / (h * h) * s * s;
  }
  HYST_HD Real largest_stiffness() const { return b2; }
};

struct BridsonLaw {
  static constexpr const char* kName = "bridson";
  static constexpr const char* kMeaning = "(2 b2/h) sin(K h/2), no memory (Bridson et al. 2003)";
  static constexpr LawFamily kFamily = LawFamily::elastic;
  static std::vector<LawParameter> parameters() { return {law_parameter::height()}; }

  template <class Real, int D>
  static Bridson<Real, D> make(const LawParams& c) {
    return Bridson<Real, D>::make(c.curve, c.height);
  }
};

}  // namespace hysteron
