// What a vertex may do beside a solid: not go through it.  A segment of its path is followed by the signed
// distance, which never exceeds the way to the surface (sphere tracing, Hart 1996, "conservative advancement"
// of a point).
//
// Solids give way by design, so that a vertex may be a little inside; past the middle of the thinnest part
// the shell would push it out on the other side.  A segment therefore leads at most half of what is left to
// the middle deeper.  Where the obstacle moves, the path is that beside it: it starts where the vertex would
// be had the obstacle carried it along, and is straight in the obstacle's frame.
#pragma once

#include "sim/contact/obstacle_set.h"

namespace hysteron {

inline constexpr int kMaxAdvances = 100;  // then the rest of the segment counts as barred
inline constexpr double kTouching =
    0.02;  // of the distance at the start, or of the thinnest part: this near the path ends

// Where x of the step's start would be at its end, had the obstacle carried it.
template <class Real>
HYST_HD Vec3<Real> carried(const Obstacle3<Real>& obstacle, const Vec3<Real>& x) {
  const Real scale2 = obstacle.back_rotation.col(0).squaredNorm();
  return obstacle.back_rotation.transpose() * (x - obstacle.back_translation) / scale2;
}

// Share of a path of this length on which what moves along it, at `distance` from the surface at first, stays
// above `depth` below it; distance_at(share) from there on.
template <class Real, class DistanceAt>
HYST_HD Real fraction_above(Real length, Real distance, Real depth, Real thinnest,
                            const DistanceAt& distance_at) {
  const Real first = distance + depth;
  if (!(length > first)) return 1;
  if (!(first > 0)) return 0;
  const Real near = static_cast<Real>(kTouching) * (first < thinnest ? first : thinnest);
  Real gone = 0, free = first;
  for (int k = 0; k < kMaxAdvances; ++k) {
    const Real safe = static_cast<Real>(1 - kTouching) * free, next = gone + (safe > near ? safe : near);
    const bool at_end = !(next < length);
    const Real reached = at_end ? length : next;
    free = distance_at(reached / length) + depth;
    if (!(free > 0)) break;
    if (at_end) return 1;
    gone = reached;
    if (free < near) break;
  }
  return gone / length;
}

// Of a point that starts at `from` and goes `displacement`.
template <class Real>
HYST_HD Real fraction_above(const Obstacle3<Real>& obstacle, const Vec3<Real>& from,
                            const Vec3<Real>& displacement, Real distance, Real depth) {
  return fraction_above<Real>(displacement.norm(), distance, depth, obstacle.thinnest, [&](Real fraction) {
    return distance_to<Real>(obstacle, from + fraction * displacement).value;
  });
}

// Share of `displacement` from `from` on which a point does not go through the obstacle.  One that is past
// the middle already may go anywhere.
template <class Real>
HYST_HD Real free_fraction(const Obstacle3<Real>& obstacle, const Vec3<Real>& from,
                           const Vec3<Real>& displacement) {
  const Real distance = distance_to(obstacle, from).value, deep = distance < 0 ? -distance : Real(0);
  if (!(deep < obstacle.thinnest)) return 1;
  return fraction_above(obstacle, from, displacement, distance, (deep + obstacle.thinnest) / 2);
}

// Whether a vertex that was at `start` can be at `end` without having gone through an obstacle.
template <class Real>
HYST_HD bool path_is_clear(const ObstacleSet<Real>& set, const Vec3<Real>& start, const Vec3<Real>& end) {
  for (int o = 0; o < set.count; ++o) {
    if (!set.item[o].is_thin()) continue;
    const Vec3<Real> from = carried(set.item[o], start);
    if (free_fraction<Real>(set.item[o], from, end - from) < 1) return false;
  }
  return true;
}

// `end`, or where the path there comes within `rest_distance` of an obstacle that bars it.
template <class Real>
HYST_HD Vec3<Real> kept_out(const ObstacleSet<Real>& set, const Vec3<Real>& start, Vec3<Real> end,
                            Real rest_distance) {
  for (int o = 0; o < set.count; ++o) {
    const Obstacle3<Real>& obstacle = set.item[o];
    if (!obstacle.is_thin()) continue;
    const Vec3<Real> from = carried(obstacle, start), displacement = end - from;
    if (free_fraction(obstacle, from, displacement) < 1)
      end = from +
            fraction_above(obstacle, from, displacement, distance_to(obstacle, from).value, -rest_distance) *
                displacement;
  }
  return end;
}

}  // namespace hysteron
