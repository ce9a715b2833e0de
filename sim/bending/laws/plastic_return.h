// Returns an elastic stretch that yields: the step that all laws with a plastic rest curvature share.
//
// A trial stretch e = K - K_p of length n beyond the yield curvature y is returned along itself to a length
//   held = y + f (n - y)      `hardening`:  f = 0 perfectly plastic, f > 0 what is left of the excess
//   held = max(y, f n)        `relaxing`:   the whole stretch decays, down to y
// and K_p takes up the rest.  held is an increasing function of n, so that its integral is a convex
// potential. What is lost, per unit of stiffness:
//   yielding is done on the way:    the potential less the energy of what is held
//   creep is done at the end of it: (n^2 - held^2)/2
#pragma once

#include "sim/bending/laws/law.h"

namespace hysteron {

template <class Real>
struct PlasticReturn {
  Real held;   // length of the returned stretch [1/m]
  Real slope;  // d held/d n

  HYST_HD static PlasticReturn hardening(Real n, Real y, Real f) {
    return n > y ? PlasticReturn{y + f * (n - y), f} : PlasticReturn{n, 1};
  }
  HYST_HD static PlasticReturn relaxing(Real n, Real y, Real f) {
    if (!(n > y)) return {n, 1};
    return f * n > y ? PlasticReturn{f * n, f} : PlasticReturn{y, 0};
  }

  // Return losses [1/m^2], which times the rigidity are [J/m^2].
  HYST_HD Real lost_by_yielding(Real n, Real y) const { return (n - held) * (y + held) / 2; }
  HYST_HD Real lost_by_creep(Real n) const { return (n - held) * (n + held) / 2; }
};

// The returned stretch as a vector.
template <class Real, int D>
struct PlasticFlow {
  Vec<Real, D> elastic;      // [1/m]
  Vec<Real, D> set;          // K_p after the step [1/m]
  Real moved;                // |change of K_p| [1/m]
  Tangent<Real, D> tangent;  // d elastic/d K
};

// Moves K_p along the trial stretch; a scalar one no further than |K_p| <= bound, beyond which the cloth is
// elastic. (A tensor that meets a bound would have to slide along it: bounded laws run along four
// directions.)
template <class Real, int D>
HYST_HD PlasticFlow<Real, D> plastic_flow(const Vec<Real, D>& trial, Real n, const Vec<Real, D>& set,
                                          PlasticReturn<Real> returned, Real bound) {
  const Tangent<Real, D> one = Tangent<Real, D>::Identity();
  if (!(n > returned.held)) return {trial, set, 0, one};
  const Vec<Real, D> along = trial / n;
  Real moved = n - returned.held, slope = returned.slope;
  if constexpr (D == 1) {
    const Real room = bound - along[0] * set[0];
    if (moved > room) moved = room, slope = 1;
  }
  const Real fraction = 1 - moved / n;
  return {trial - moved * along, set + moved * along, moved,
          fraction * one + (slope - fraction) * along * along.transpose()};
}

}  // namespace hysteron
