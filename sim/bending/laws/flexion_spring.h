// Flexion springs of mass-spring cloth (Provot 1995; the seed's chapter 3) have rest length 2 h and join the
// two corners opposite to an edge.  Folded by theta a spring is 2 h cos(theta/2) long, and with K = theta/h
//   M = c (1 - cos(K h/2)) sin(K h/2),   c such that M(K0) = b2 K0.
// It carries nothing at small bends (M ~ K^3) and grows very stiff when folded: dM/dK up to 9/16 c h.
#pragma once

#include <cmath>
#include <numbers>

#include "sim/bending/laws/law_description.h"
#include "sim/bending/laws/radial_elastic.h"

namespace hysteron {

template <class Real, int D>
struct FlexionSpring : RadialElastic<FlexionSpring<Real, D>, Real, D> {
  Real c = 0;  // [N]
  Real h = 0;  // height of the hinge [m]

  static FlexionSpring make(const VirginCurve& curve, double height) {
    const double x = curve.k0 * height / 2, s = std::sin(x / 2);
    FlexionSpring law;
    law.c = Real(curve.b2 * curve.k0 / (2 * s * s * std::sin(x)));
    law.h = Real(height);
    return law;
  }

  HYST_HD Real secant(Real k) const {
    using std::sin;
    const Real x = k * h / 2, s = sin(x / 2);
    return x > 0 ? c * h * s * s * sin(x) / x : Real(0);
  }
  HYST_HD Real slope(Real k) const {
    using std::cos;
    const Real x = k * h / 2;
    return c * h / 2 * (cos(x) - cos(2 * x));
  }
  HYST_HD Real energy(Real k) const {
    using std::sin;
    const Real s = sin(k * h / 4);
    return 4 * c / h * s * s * s * s;
  }
  HYST_HD Real largest_stiffness() const { return Real(9) / 16 * c * h; }
};

struct FlexionSpringLaw {
  static constexpr const char* kName = "spring";
  static constexpr const char* kMeaning =
      "flexion springs across the hinge, matched to b2 K at K0 (mass-spring model)";
  static constexpr LawFamily kFamily = LawFamily::elastic;
  static std::vector<LawParameter> parameters() { return {law_parameter::height()}; }
  static void check(const LawParams& c, LawUse) {
    // When folded, the springs are 9/(k0 height)^2 times as rigid as where they are matched: here 90,000
    // times.
    constexpr double kMin = 0.01;
    const double angle = c.curve.k0 * c.height;
    if (!(angle >= kMin && angle < 2 * std::numbers::pi))
      c.refuse("height",
               "height = " + shown(c.height) + " m and k0 = " + shown(c.curve.k0) +
                   " 1/m must give a hinge angle k0 * height in [0.01, 2 pi), where the springs are matched; "
                   "folded "
                   "further, springs matched at a smaller one are so stiff that they crush the triangles");
  }

  template <class Real, int D>
  static FlexionSpring<Real, D> make(const LawParams& c) {
    return FlexionSpring<Real, D>::make(c.curve, c.height);
  }
};

}  // namespace hysteron
