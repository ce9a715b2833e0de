// One friction element whose stiffness and threshold differ by direction.
//
//   least  (E - U)^T A (E - U)/2  with  E^T B E <= 1,   A, B diagonal and positive
//   E = (A + l B)^-1 A U,   l >= 0 the multiplier: 0 inside, else of E^T B E = 1
//
// The slip U - E follows the normal of the surface in moments (maximal dissipation): what is lost is
// (A E).(U - E) = l, never negative, and the potential, the Moreau envelope of the bound, is convex in U.
// With A and B multiples of one matrix it is the radial return.  The stiffnesses may be 0 together.
#pragma once

#include <cmath>

#include "sim/bending/laws/law.h"

namespace hysteron {

template <class Real>
struct StopReturn {
  Vec<Real, 3> elastic;  // E [1/m]
  Real multiplier;       // l [J/m^2]
};

template <class Real>
struct StopEllipsoid {
  Vec<Real, 3> stiffness;  // A [N m]
  Vec<Real, 3> bound;      // B [m^2]

  // The multiplier by Newton's method on 1/|B^1/2 E| - 1, which is nearly linear in it and concave, so that
  // from l = 0 every step stays on one side (as for trust regions: More & Sorensen 1983).
  [[gnu::noinline]] HYST_HD StopReturn<Real> returned(const Vec<Real, 3>& offset) const {
    using std::sqrt;
    constexpr int kMostSteps = 40;
    constexpr Real kPrecision = Real(sizeof(Real) == 8 ? 1e-15 : 4e-7);
    if (!(offset.dot(bound.cwiseProduct(offset)) > 1)) return {offset, 0};
    if (!(stiffness[0] > 0)) return {offset / sqrt(offset.dot(bound.cwiseProduct(offset))), 0};
    Real multiplier = 0;
    Vec<Real, 3> elastic = offset;
    for (int i = 0; i < kMostSteps; ++i) {
      const Vec<Real, 3> softer = stiffness + multiplier * bound;
      elastic = stiffness.cwiseProduct(offset).cwiseQuotient(softer);
      const Real squared = elastic.dot(bound.cwiseProduct(elastic)), size = sqrt(squared);
      if (!(size - 1 > kPrecision)) break;
      const Vec<Real, 3> normal = bound.cwiseProduct(elastic);
      multiplier += (size - 1) * squared / normal.dot(normal.cwiseQuotient(softer));
    }
    return {elastic, multiplier};
  }

  // d(A E)/dU
  HYST_HD Tangent<Real, 3> tangent(const StopReturn<Real>& now) const {
    const Vec<Real, 3> softer = stiffness + now.multiplier * bound;
    Tangent<Real, 3> result = Tangent<Real, 3>::Zero();
    if (!(stiffness[0] > 0)) return result;
    for (int c = 0; c < 3; ++c) result(c, c) = stiffness[c] * stiffness[c] / softer[c];
    if (!(now.multiplier > 0)) return result;
    const Vec<Real, 3> normal = bound.cwiseProduct(now.elastic),
                       turned = stiffness.cwiseProduct(normal).cwiseQuotient(softer);
    return result - turned * turned.transpose() / normal.dot(normal.cwiseQuotient(softer));
  }
};

}  // namespace hysteron
