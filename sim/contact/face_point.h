// The point of a triangle that is nearest to a convex solid (Macklin, Erleben, Mueller, Chentanez, Jeschke &
// Corse 2020, "Local optimization for robust signed distance field collision").
//
//   d = min over w of  phi(sum w_k p_k) + c |w - 1/3|^2,   w_k >= 0, sum w_k = 1
//
// phi, the signed distance of a convex solid, is convex, so that the minimum is one of nested convex
// functions of one variable.  c > 0 makes the point unique where the solid's edge or side runs along the
// triangle: it then moves on without jumps, and d has a gradient, w_k n at corner k (envelope theorem).
#pragma once

#include "sim/contact/signed_distance.h"

namespace hysteron {

template <class Real>
struct FacePoint {
  Vec3<Real> weight;
  Real distance;      // d [m]
  Vec3<Real> normal;  // gradient of phi; where phi has a kink the mean of both sides' that keeps the point
};

// Slope of a convex function, with what it was found from.
template <class Real>
struct Incline {
  Real slope;
  Vec3<Real> normal;
  Real inner;  // the other variable
};

template <class Real>
struct Lowest {
  Real at;
  Vec3<Real> normal;
  Real inner;
};

// Where in [0, 1] a convex function is least: its slope's zero, by regula falsi (Illinois) with bisections.
template <class Real, class SlopeAt>
HYST_HD Lowest<Real> lowest(const SlopeAt& slope_at) {
  constexpr int kMostCuts = 60;
  constexpr Real kFlat = sizeof(Real) == 8 ? Real(1e-11) : Real(1e-5);  // of the slopes' difference
  constexpr Real kNarrow = sizeof(Real) == 8 ? Real(1e-13) : Real(1e-6);
  Incline<Real> low = slope_at(Real(0));
  if (!(low.slope < 0)) return {0, low.normal, low.inner};
  Incline<Real> high = slope_at(Real(1));
  if (!(high.slope > 0)) return {1, high.normal, high.inner};
  const Real enough = kFlat * (high.slope - low.slope);
  Real a = 0, b = 1, at_a = low.slope, at_b = high.slope;
  int side = 0;
  for (int k = 0; k < kMostCuts && b - a > kNarrow; ++k) {
    Real next = a - at_a * (b - a) / (at_b - at_a);
    if (k % 3 == 2 || !(next > a && next < b)) next = (a + b) / 2;
    const Incline<Real> here = slope_at(next);
    if (here.slope <= enough && here.slope >= -enough) return {next, here.normal, here.inner};
    if (here.slope < 0) {
      if (side < 0) at_b /= 2;
      a = next;
      low = here;
      at_a = here.slope;
      side = -1;
    } else {
      if (side > 0) at_a /= 2;
      b = next;
      high = here;
      at_b = here.slope;
      side = 1;
    }
  }
  const Real share = low.slope / (low.slope - high.slope);  // a kink: slopes of both sides that cancel
  return {a + share * (b - a), low.normal + share * (high.normal - low.normal),
          low.inner + share * (high.inner - low.inner)};
}

// Corners p and the point in the solid's frame; `centring` is c [m].
template <class Real>
HYST_HD HYST_NOINLINE FacePoint<Real> face_point(const Shape<Real>& shape, const Vec3<Real> (&p)[3],
                                                 Real centring) {
  const Vec3<Real> p0 = p[0], p1 = p[1], p2 = p[2];
  const Lowest<Real> found = lowest<Real>([&](Real a) {
    const Real rest = 1 - a;
    const Lowest<Real> across = lowest<Real>([&](Real t) {
      const Vec3<Real> at = a * p0 + rest * ((1 - t) * p1 + t * p2);
      const Vec3<Real> n = signed_distance(shape, at).normal;
      return Incline<Real>{n.dot(p2 - p1) + 2 * centring * rest * (2 * t - 1), n, t};
    });
    const Real t = across.at;
    const Real centre = a - rest * ((1 - t) * (1 - t) + t * t);
    return Incline<Real>{across.normal.dot(p0 - (1 - t) * p1 - t * p2) + 2 * centring * centre, across.normal,
                         t};
  });
  const Real rest = 1 - found.at;
  FacePoint<Real> point;
  point.weight = {found.at, rest * (1 - found.inner), rest * found.inner};
  const Vec3<Real> at = point.weight[0] * p0 + point.weight[1] * p1 + point.weight[2] * p2;
  point.distance =
      signed_distance(shape, at).value + centring * (point.weight.squaredNorm() - Real(1) / Real(3));
  point.normal = found.normal;
  return point;
}

// No point of the triangle is nearer to a convex solid.
template <class Real>
HYST_HD Real least_possible(const Shape<Real>& shape, const Vec3<Real> (&p)[3]) {
  const Vec3<Real> centre = (p[0] + p[1] + p[2]) / 3;
  const Distance<Real> d = signed_distance(shape, centre);
  Real least = 0;
  for (const Vec3<Real>& corner : p) {
    const Real along = d.normal.dot(corner - centre);
    least = along < least ? along : least;
  }
  return d.value + least;
}

}  // namespace hysteron
