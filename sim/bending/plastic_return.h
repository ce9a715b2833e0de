// What an elastic stretch that yields becomes: the step that all laws with a plastic rest curvature share.
//
// A trial stretch e = K - K_p of length n beyond the yield curvature y is returned along itself to a length
//   held = y + f (n - y)      `hardening`:  f = 0 perfectly plastic, f > 0 what is left of the excess
//   held = max(y, f n)        `relaxing`:   the whole stretch decays, down to y
// and K_p takes up the rest.  held is an increasing function of n, so that its integral W is the convex
// incremental potential, and what is lost is W minus the energy of the returned stretch, never negative.
// All per unit of stiffness: multiply by the rigidity.
#pragma once

#include "sim/bending/law.h"

namespace hysteron {

template <class Real>
struct PlasticReturn {
  Real held;   // length of the returned stretch [1/m]
  Real slope;  // d held/d n
  Real lost;   // [1/m^2]; times the rigidity: J/m^2

  HYST_HD static PlasticReturn hardening(Real n, Real y, Real f) {
    const Real excess = n - y;
    if (!(excess > 0)) return {n, 1, 0};
    return {y + f * excess, f, (1 - f) * excess * (y + f * excess / 2)};
  }
  HYST_HD static PlasticReturn relaxing(Real n, Real y, Real f) {
    if (!(n > y)) return {n, 1, 0};
    if (f * n > y) return {f * n, f, (1 - f) / 2 * (y * y / f + f * n * n)};
    return {y, 0, y * (n - y)};
  }

  // Derivative of the returned stretch by the trial stretch, of length n > 0 or unyielded.
  template <int D>
  HYST_HD Tangent<Real, D> derivative(const Vec<Real, D>& trial, Real n) const {
    if (!(n > held)) return Tangent<Real, D>::Identity();
    const Real share = held / n;
    return share * Tangent<Real, D>::Identity() + (slope - share) / (n * n) * trial * trial.transpose();
  }
};

// The first D numbers of a history as a vector, and back.
template <class Real, int D, int N>
HYST_HD Vec<Real, D> load_set(const History<Real, N>& history, int first = 0) {
  Vec<Real, D> set;
  for (int c = 0; c < D; ++c) set[c] = history[first + c];
  return set;
}
template <class Real, int D, int N>
HYST_HD void store_set(const Vec<Real, D>& set, History<Real, N>& history, int first = 0) {
  for (int c = 0; c < D; ++c) history[first + c] = set[c];
}

}  // namespace hysteron
