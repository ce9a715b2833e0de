// The shape that every moment-curvature law has.
//
// A law is a small value with its parameters.  It maps a curvature (D components: 1 on the `hinge` element, 3
// on the `shape` element, where S = (S_xx, S_yy, sqrt2 S_xy)) and the history before the step to the moment
// and the history after it.  History goes in and comes out by value, so that a rejected step costs nothing.
//
//   struct SomeLaw<Real, D> {
//     static constexpr int kDimension = D;
//     static constexpr int kHistory = ...;  // Reals remembered per element, 0 if none
//     // On host and device: the step, and dM/dK of it [N m].
//     LawStep<Real, D, kHistory> step(Vec<Real, D> curvature, const History& before) const;
//     Tangent<Real, D> tangent(Vec<Real, D> curvature, const History& before) const;
//     Vec<Real, D> residual(const History& history) const;  // curvature at which the moment is zero [1/m]
//     Real largest_stiffness() const;                       // bound on the eigenvalues of dM/dK [N m]
//   };
//
// Units: curvature 1/m, moment N (per unit width), energies J/m^2.
#pragma once

#include "sim/device/host_device.h"

namespace hysteron {

// What a law remembers for one element: N Reals, all zero for virgin cloth.  N = 0 takes no memory in a
// scene.
template <class Real, int N>
struct History {
  Real slot[N] = {};
  HYST_HD Real& operator[](int i) { return slot[i]; }
  HYST_HD Real operator[](int i) const { return slot[i]; }
};
template <class Real>
struct History<Real, 0> {};

template <class Real, int D, int N>
struct LawStep {
  Vec<Real, D> moment;         // M at the new curvature [N]
  Real stored = 0;             // recoverable energy after the step [J/m^2]
  Real dissipated = 0;         // energy lost in this step [J/m^2]; never negative for a passive law
  History<Real, N> history{};  // memory after the step
};

template <class Real, int D>
using Tangent = Eigen::Matrix<Real, D, D>;

// The three numbers that define a fabric's bending (model: M = b1 K + c1 K^2 up to K0, then M0 + b2 K).
struct VirginCurve {
  double b1;  // initial bending rigidity [N m], b1 >= b2
  double b2;  // bending rigidity B of the straight branch [N m]
  double k0;  // elastic limit, the curvature at which friction saturates [1/m]

  double friction_moment() const { return (b1 - b2) * k0 / 2; }                // M0 = HB [N]
  double elastic_limit_moment() const { return friction_moment() + b2 * k0; }  // Ma [N]
  double c1() const { return k0 > 0 ? (b2 - b1) / (2 * k0) : 0; }  // quadratic coefficient [N m^2]
};

}  // namespace hysteron
