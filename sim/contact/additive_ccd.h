// Bounds how far four vertices may go along their directions until a point meets a triangle, or an edge an
// edge.
//
// Source: Li, Kaufman & Jiang 2021 (Codimensional Incremental Potential Contact), additive continuous
// collision detection: each advance is no longer than the distance that is left over the fastest approach.
#pragma once

#include "sim/device/host_device.h"

namespace hysteron {

// Finds the closest points of a point and a triangle, and of two segments, as weights of their four vertices.
//
// Source: Ericson 2005, Real-Time Collision Detection, 5.1.5 and 5.1.9 (the regions by their sign tests).

// The vector offset = sum of weight[k] x[k] [m] leads from the second figure's closest point to the first
// one's; its length is the distance, whose gradient by vertex k is weight[k] offset/|offset|.
template <class Real>
struct ClosestPoints {
  Vec<Real, 4> weight;
  Vec3<Real> offset;
};

// Returns the barycentric coordinates of the point of a triangle nearest to p.
template <class Real>
HYST_HD Vec3<Real> nearest_in_triangle(const Vec3<Real>& p, const Vec3<Real>& a, const Vec3<Real>& b,
                                       const Vec3<Real>& c) {
  const Vec3<Real> ab = b - a, ac = c - a, ap = p - a;
  const Real d1 = ab.dot(ap), d2 = ac.dot(ap);
  if (d1 <= 0 && d2 <= 0) return {1, 0, 0};
  const Vec3<Real> bp = p - b;
  const Real d3 = ab.dot(bp), d4 = ac.dot(bp);
  if (d3 >= 0 && d4 <= d3) return {0, 1, 0};
  const Real vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return {1 - d1 / (d1 - d3), d1 / (d1 - d3), 0};
  const Vec3<Real> cp = p - c;
  const Real d5 = ab.dot(cp), d6 = ac.dot(cp);
  if (d6 >= 0 && d5 <= d6) return {0, 0, 1};
  const Real vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return {1 - d2 / (d2 - d6), 0, d2 / (d2 - d6)};
  const Real va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 >= d3 && d5 >= d6) {
    const Real w = (d4 - d3) / (d4 - d3 + (d5 - d6));
    return {0, 1 - w, w};
  }
  const Real sum = va + vb + vc;
  return {1 - vb / sum - vc / sum, vb / sum, vc / sum};
}

template <class Real>
HYST_HD ClosestPoints<Real> point_triangle(const Vec3<Real> (&x)[4]) {
  const Vec3<Real> b = nearest_in_triangle<Real>(x[0], x[1], x[2], x[3]);
  ClosestPoints<Real> closest;
  closest.weight << 1, -b[0], -b[1], -b[2];
  closest.offset = b[0] * (x[0] - x[1]) + b[1] * (x[0] - x[2]) + b[2] * (x[0] - x[3]);
  return closest;
}

template <class Real>
HYST_HD Real within_unit(Real value) {
  return value < 0 ? Real(0) : (value > 1 ? Real(1) : value);
}

// Finds the closest points of the segments x0-x1 and x2-x3, neither of them a point.
template <class Real>
HYST_HD ClosestPoints<Real> edge_edge(const Vec3<Real> (&x)[4]) {
  const Vec3<Real> u = x[1] - x[0], v = x[3] - x[2], r = x[0] - x[2];
  const Real a = u.squaredNorm(), e = v.squaredNorm(), f = v.dot(r), c = u.dot(r), b = u.dot(v);
  const Real denominator = a * e - b * b;
  Real s = denominator > 0 ? within_unit((b * f - c * e) / denominator) : Real(0);
  Real t = (b * s + f) / e;
  if (t < 0) {
    t = 0;
    s = within_unit(-c / a);
  } else if (t > 1) {
    t = 1;
    s = within_unit((b - c) / a);
  }
  ClosestPoints<Real> closest;
  closest.weight << 1 - s, s, t - 1, -t;
  closest.offset = r + s * u - t * v;
  return closest;
}

// Returns an upper bound of the relative displacement of any two points of the two figures [m].
template <class Real>
HYST_HD Real fastest_approach(const Vec3<Real> (&direction)[4], bool edges) {
  using std::sqrt;
  const Real n0 = direction[0].squaredNorm(), n1 = direction[1].squaredNorm(),
             n2 = direction[2].squaredNorm(), n3 = direction[3].squaredNorm();
  const auto larger = [](Real a, Real b) { return a > b ? a : b; };
  return edges ? sqrt(larger(n0, n1)) + sqrt(larger(n2, n3)) : sqrt(n0) + sqrt(larger(n1, larger(n2, n3)));
}

// Subtracts the mean of the four directions from each.
template <class Real>
HYST_HD void remove_mean(Vec3<Real> (&direction)[4]) {
  const Vec3<Real> mean = Real(0.25) * (direction[0] + direction[1] + direction[2] + direction[3]);
  for (Vec3<Real>& d : direction) d -= mean;
}

template <class Real>
HYST_HD Real pair_distance(const Vec3<Real> (&x)[4], bool edges) {
  return (edges ? edge_edge(x) : point_triangle(x)).offset.norm();
}

// Two figures at the start of a path: nowhere on it are they nearer than distance - speed [m].
template <class Real>
struct Approach {
  Real distance, speed;
};

template <class Real>
HYST_HD Approach<Real> approach(const Vec3<Real> (&x)[4], Vec3<Real> (&direction)[4], bool edges) {
  remove_mean(direction);
  return {pair_distance(x, edges), fastest_approach(direction, edges)};
}

// Returns the step length in [0, 1] along the directions up to which the distance stays above `least` [m]: 1,
// or the point where a twentieth to a tenth of the initial excess over `least` is left.  `start` is the
// approach of x and direction, which are overwritten.
template <class Real>
HYST_HD Real feasible_step(const Approach<Real>& start, Vec3<Real> (&x)[4], Vec3<Real> (&direction)[4],
                           bool edges, Real least) {
  constexpr Real kKept = Real(0.1);
  constexpr int kMaxAdvances = 1000;
  const Real speed = start.speed;
  Real gap = start.distance - least;
  if (!(speed > 0) || gap > speed) return 1;
  if (!(gap > 0)) return 0;
  const Real kept = kKept * gap;
  Real step_length = 0;
  for (int k = 0; k < kMaxAdvances && gap >= kept; ++k) {
    const Real advance = (gap - kept / 2) / speed;
    step_length += advance;
    if (step_length >= 1) return 1;
    for (int i = 0; i < 4; ++i) x[i] += advance * direction[i];
    gap = pair_distance(x, edges) - least;
  }
  return step_length;
}

}  // namespace hysteron
