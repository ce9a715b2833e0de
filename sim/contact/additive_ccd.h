// How far four vertices may go along their ways until a point meets a triangle, or an edge an edge.
//
// Source: Li, Kaufman & Jiang 2021 (Codimensional Incremental Potential Contact), additive continuous
// collision detection: each advance is no longer than the distance that is left over the fastest approach.
#pragma once

#include "sim/contact/closest_points.h"

namespace hysteron {

// Upper bound of the relative displacement of any two points of the two figures.
template <class Real>
HYST_HD Real fastest_approach(const Vec3<Real> (&way)[4], bool edges) {
  using std::sqrt;
  const Real n0 = way[0].squaredNorm(), n1 = way[1].squaredNorm(), n2 = way[2].squaredNorm(),
             n3 = way[3].squaredNorm();
  const auto larger = [](Real a, Real b) { return a > b ? a : b; };
  return edges ? sqrt(larger(n0, n1)) + sqrt(larger(n2, n3)) : sqrt(n0) + sqrt(larger(n1, larger(n2, n3)));
}

// Takes the motion that all four share out of their ways.
template <class Real>
HYST_HD void remove_mean(Vec3<Real> (&way)[4]) {
  const Vec3<Real> mean = Real(0.25) * (way[0] + way[1] + way[2] + way[3]);
  for (Vec3<Real>& w : way) w -= mean;
}

template <class Real>
HYST_HD Real distance_of(const Vec3<Real> (&x)[4], bool edges) {
  return (edges ? edge_edge(x) : point_triangle(x)).offset.norm();
}

// Share in [0, 1] of the ways on which the distance stays above `least`: all of it, or up to where between a
// twentieth and a tenth of what the distance exceeded `least` by is left.  x and way are spoilt.
template <class Real>
HYST_HD Real feasible_share(Vec3<Real> (&x)[4], Vec3<Real> (&way)[4], bool edges, Real least) {
  constexpr Real kKept = Real(0.1);
  constexpr int kMostAdvances = 1000;
  remove_mean(way);
  const Real speed = fastest_approach(way, edges);
  Real gap = distance_of(x, edges) - least;
  if (!(speed > 0) || gap > speed) return 1;
  if (!(gap > 0)) return 0;
  const Real kept = kKept * gap;
  Real share = 0;
  for (int k = 0; k < kMostAdvances && gap >= kept; ++k) {
    const Real advance = (gap - kept / 2) / speed;
    share += advance;
    if (share >= 1) return 1;
    for (int i = 0; i < 4; ++i) x[i] += advance * way[i];
    gap = distance_of(x, edges) - least;
  }
  return share;
}

}  // namespace hysteron
