// How far four vertices may go along their directions until a point meets a triangle, or an edge an edge.
//
// Source: Li, Kaufman & Jiang 2021 (Codimensional Incremental Potential Contact), additive continuous
// collision detection: each advance is no longer than the distance that is left over the fastest approach.
#pragma once

#include "sim/contact/closest_points.h"

namespace hysteron {

// Upper bound of the relative displacement of any two points of the two figures.
template <class Real>
HYST_HD Real fastest_approach(const Vec3<Real> (&direction)[4], bool edges) {
  using std::sqrt;
  const Real n0 = direction[0].squaredNorm(), n1 = direction[1].squaredNorm(),
             n2 = direction[2].squaredNorm(), n3 = direction[3].squaredNorm();
  const auto larger = [](Real a, Real b) { return a > b ? a : b; };
  return edges ? sqrt(larger(n0, n1)) + sqrt(larger(n2, n3)) : sqrt(n0) + sqrt(larger(n1, larger(n2, n3)));
}

// Takes the motion that all four have in common out of their directions.
template <class Real>
HYST_HD void remove_mean(Vec3<Real> (&direction)[4]) {
  const Vec3<Real> mean = Real(0.25) * (direction[0] + direction[1] + direction[2] + direction[3]);
  for (Vec3<Real>& d : direction) d -= mean;
}

template <class Real>
HYST_HD Real distance_of(const Vec3<Real> (&x)[4], bool edges) {
  return (edges ? edge_edge(x) : point_triangle(x)).offset.norm();
}

// Two figures at the start of a path: nowhere on it are they nearer than distance - speed.
template <class Real>
struct Approach {
  Real distance, speed;
};

template <class Real>
HYST_HD Approach<Real> approach(const Vec3<Real> (&x)[4], Vec3<Real> (&direction)[4], bool edges) {
  remove_mean(direction);
  return {distance_of(x, edges), fastest_approach(direction, edges)};
}

// Step length in [0, 1] along the directions up to which the distance stays above `least`: 1, or where
// between a twentieth and a tenth of what the distance exceeded `least` by is left.  `start` is the approach
// of x and direction, which are spoilt.
template <class Real>
HYST_HD Real feasible_step(const Approach<Real>& start, Vec3<Real> (&x)[4], Vec3<Real> (&direction)[4],
                           bool edges, Real least) {
  constexpr Real kKept = Real(0.1);
  constexpr int kMostAdvances = 1000;
  const Real speed = start.speed;
  Real gap = start.distance - least;
  if (!(speed > 0) || gap > speed) return 1;
  if (!(gap > 0)) return 0;
  const Real kept = kKept * gap;
  Real step_length = 0;
  for (int k = 0; k < kMostAdvances && gap >= kept; ++k) {
    const Real advance = (gap - kept / 2) / speed;
    step_length += advance;
    if (step_length >= 1) return 1;
    for (int i = 0; i < 4; ++i) x[i] += advance * direction[i];
    gap = distance_of(x, edges) - least;
  }
  return step_length;
}

}  // namespace hysteron
