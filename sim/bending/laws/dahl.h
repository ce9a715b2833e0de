// Friction that relaxes exponentially to its limit (Dahl 1968; for cloth Miguel et al. 2013; the same as the
// first-order model of Bliman & Sorine 1995).  No return-point memory.
//
//   M = b2 K + F,   F <- s M0 + (F_r - s M0) exp(-|dK|/l),   l = K0/2,   stored b2 K^2/2 + F^2/(2 (b1 - b2))
//
// with M0/l = b1 - b2 the first slope.  On the tensor the step dK = d n is a straight way, and the law is the
// gradient of W = M0 (d - l (1 - E)) + (F_r . dK) phi,  E = exp(-d/l),  phi = (1 - E) l/d:
//   F = M0 (1 - E) n + F_r phi + (F_r . n)(E - phi) n
// (ours): the part of F_r along the step decays as above, the part across half as fast.  For a cylinder in
// any direction it is the scalar law.  Energy is lost at the rate (F_along^2 + F_across^2/2)/M0 per
// curvature.
#pragma once

#include <cmath>

#include "sim/bending/laws/law_description.h"
#include "sim/bending/laws/zero_moment.h"

namespace hysteron {

template <class Real, int D>
struct Dahl {
  static constexpr int kDimension = D;
  static constexpr int kHistory = 2 * D;  // curvature [1/m], F [N]
  using Scalar = Real;
  using Memory = History<Real, kHistory>;

  Real b2 = 0;  // rigidity of the straight branch [N m]
  Real g = 0;   // b1 - b2 [N m]
  Real m0 = 0;  // friction moment [N]
  Real l = 1;   // curvature over which friction relaxes [1/m]

  static Dahl make(const VirginCurve& curve) {
    if (!(curve.k0 > 0 && curve.b1 > curve.b2)) return {Real(curve.b2), 0, 0, 1};
    return {Real(curve.b2), Real(curve.b1 - curve.b2), Real(curve.friction_moment()), Real(curve.k0 / 2)};
  }

  HYST_HD LawStep<Real, D, kHistory> step(const Vec<Real, D>& curvature, const Memory& before) const {
    const Vec<Real, D> held = load_set<Real, D>(before, D);
    const Increment increment = increment_to(curvature, before);
    const Real ahead = held.dot(increment.along);
    Vec<Real, D> friction = increment.fraction * held;
    friction += (m0 * increment.gone + ahead * (increment.left - increment.fraction)) * increment.along;
    LawStep<Real, D, kHistory> result;
    store_set<Real, D>(curvature, result.history);
    store_set<Real, D>(friction, result.history, D);
    result.moment = b2 * curvature + friction;
    result.stored = b2 * curvature.squaredNorm() / 2 + energy(friction);
    const Real work =
        m0 * (increment.length - l * increment.gone) + ahead * increment.length * increment.fraction;
    result.dissipated = work - energy(friction) + energy(held);
    return result;
  }

  // Returns the Hessian of W; at a step of length zero, where it depends on the direction to come, that for
  // F_r = 0.
  HYST_HD Tangent<Real, D> tangent(const Vec<Real, D>& curvature, const Memory& before) const {
    const Tangent<Real, D> one = Tangent<Real, D>::Identity();
    const Increment increment = increment_to(curvature, before);
    if (!(increment.length > 0)) return (b2 + g) * one;
    const Vec<Real, D>& n = increment.along;
    const Vec<Real, D> held = load_set<Real, D>(before, D);
    const Tangent<Real, D> along = n * n.transpose(), across = one - along;
    const Real first = increment.fraction_slope(l), second = increment.fraction_bend(l), ahead = held.dot(n);
    Tangent<Real, D> result =
        b2 * one + m0 * (increment.left / l * along + increment.gone / increment.length * across);
    result += first * (held * n.transpose() + n * held.transpose());
    return result + ahead * (increment.length * second * along + first * across);
  }

  HYST_HD Vec<Real, D> residual(const Memory& history) const {
    return zero_moment(*this, history, load_set<Real, D>(history));
  }
  // A step that turns against sliding friction has a first slope of twice b1 - b2.
  HYST_HD Real largest_stiffness() const { return b2 + 2 * g; }

 private:
  struct Increment {
    Vec<Real, D> along;  // unit direction of the step, zero without a step
    Real length;         // [1/m]
    Real left, gone;     // E, 1 - E
    Real fraction;       // phi
    Real z;              // length / l

    static constexpr Real kSeries = Real(sizeof(Real) == 8 ? 1e-3 : 3e-2);  // below this z series are used
    HYST_HD Real fraction_slope(Real l) const {                             // d phi/d length [m]
      return z < kSeries ? (Real(-0.5) + z / 3 - z * z / 8) / l : (left - fraction) / length;
    }
    HYST_HD Real fraction_bend(Real l) const {
      if (z < kSeries) return (Real(1) / 3 - z / 4 + z * z / 10) / (l * l);
      return (-left / l - 2 * fraction_slope(l)) / length;
    }
  };

  HYST_HD Increment increment_to(const Vec<Real, D>& curvature, const Memory& before) const {
    using std::expm1;
    const Vec<Real, D> step = curvature - load_set<Real, D>(before);
    const Real d = step.norm(), z = d / l, gone = -expm1(-z);
    if (!(d > 0)) return {Vec<Real, D>::Zero(), 0, 1, 0, 1, 0};
    return {step / d, d, 1 - gone, gone, gone / z, z};
  }
  HYST_HD Real energy(const Vec<Real, D>& friction) const {
    return g > 0 ? friction.squaredNorm() / (2 * g) : Real(0);
  }
};

struct DahlLaw {
  static constexpr const char* kName = "dahl";
  static constexpr const char* kMeaning = "friction that relaxes exponentially to M0 (Miguel et al. 2013)";
  static constexpr LawFamily kFamily = LawFamily::hysteretic;
  static constexpr bool kFrictionBesideB2 = true;

  template <class Real, int D>
  static Dahl<Real, D> make(const LawParams& c) {
    return Dahl<Real, D>::make(c.curve);
  }
};

}  // namespace hysteron
