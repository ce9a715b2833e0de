// Keeps a vertex or a triangle from going through a solid.  A segment of its path is followed by the signed
// distance, which never exceeds the way to the surface (sphere tracing, Hart 1996, "conservative advancement"
// of a point).  No point of a triangle goes farther than the corner that goes farthest, so that its least
// distance can be followed like a vertex's.
//
// Solids give way by design, so that a vertex may be a little inside; past the middle of the thinnest part
// the barrier would push it out on the other side.  A segment therefore goes deeper by at most half of the
// remaining way to the middle.  Where the obstacle moves, the path is that beside it: it starts where the
// vertex would be had the obstacle carried it along, and is straight in the obstacle's frame.
#pragma once

#include "sim/contact/contact_points.h"

namespace hysteron {

inline constexpr int kMaxAdvances = 100;  // after these the rest of the segment counts as blocked
// The path ends this near to the surface, over the distance at the start or the thinnest part.
inline constexpr double kTouching = 0.02;

// Returns where a point x of the step's start would be at its end, had the obstacle carried it [m].
template <class Real>
HYST_HD Vec3<Real> carried(const Obstacle3<Real>& obstacle, const Vec3<Real>& x) {
  const Real scale2 = obstacle.back_rotation.col(0).squaredNorm();
  return obstacle.back_rotation.transpose() * (x - obstacle.back_translation) / scale2;
}

// Returns the distance of a vertex, or of a triangle's nearest point, in the solid's frame [m].
template <class Real>
HYST_HD Real least_distance(const Shape<Real>& shape, const Vec3<Real> (&p)[1]) {
  return signed_distance(shape, p[0]).value;
}
template <class Real>
HYST_HD Real least_distance(const Shape<Real>& shape, const Vec3<Real> (&p)[3]) {
  return face_point<Real>(shape, p, Real(0)).distance;
}

// The path of the corners of a contact point [m].
template <class Real, int kCorners>
struct Path {
  Vec3<Real> from[kCorners], displacement[kCorners];

  HYST_HD Real length() const {
    Real longest = 0;
    for (const Vec3<Real>& w : displacement) longest = w.norm() > longest ? w.norm() : longest;
    return longest;
  }
  HYST_HD void locate(const Obstacle3<Real>& obstacle, Real fraction, Vec3<Real> (&p)[kCorners]) const {
    for (int k = 0; k < kCorners; ++k)
      p[k] = obstacle.rotation.transpose() * (from[k] + fraction * displacement[k] - obstacle.center);
  }
  HYST_HD Real distance_at(const Obstacle3<Real>& obstacle, Real fraction) const {
    Vec3<Real> p[kCorners];
    locate(obstacle, fraction, p);
    return least_distance(obstacle.shape, p);
  }
  // Does the path stay away, as far as can be told without the triangle's nearest point?
  HYST_HD bool stays_away(const Obstacle3<Real>& obstacle) const {
    if constexpr (kCorners == 1) {
      return false;
    } else {
      Vec3<Real> p[kCorners];
      locate(obstacle, Real(0), p);
      return least_possible(obstacle.shape, p) > length();
    }
  }
};

// Returns the path beside the obstacle; beside one at rest it begins at `start`.
template <class Real, class Points>
HYST_HD Path<Real, Points::kCorners> path_beside(const Obstacle3<Real>& obstacle, const Points& points,
                                                 int point, const Vec3<Real>* start, const Vec3<Real>* end) {
  Path<Real, Points::kCorners> path;
  for (int k = 0; k < Points::kCorners; ++k) {
    const int v = points.vertex(point, k);
    path.from[k] = carried(obstacle, start[v]);
    path.displacement[k] = end[v] - path.from[k];
  }
  return path;
}

// Returns the fraction of a path, which starts at `distance` [m], on which the point stays above `depth` [m]
// below the surface.
template <class Real, int kCorners>
HYST_HD Real fraction_above(const Path<Real, kCorners>& path, const Obstacle3<Real>& obstacle, Real distance,
                            Real depth) {
  const Real length = path.length(), first = distance + depth;
  if (!(length > first)) return 1;
  if (!(first > 0)) return 0;
  const Real near = static_cast<Real>(kTouching) * (first < obstacle.thinnest ? first : obstacle.thinnest);
  Real gone = 0, free = first;
  for (int k = 0; k < kMaxAdvances; ++k) {
    const Real safe = static_cast<Real>(1 - kTouching) * free, next = gone + (safe > near ? safe : near);
    const bool at_end = !(next < length);
    const Real reached = at_end ? length : next;
    free = path.distance_at(obstacle, reached / length) + depth;
    if (!(free > 0)) break;
    if (at_end) return 1;
    gone = reached;
    if (free < near) break;
  }
  return gone / length;
}

// Returns the fraction of a path on which nothing goes through the obstacle.  A point that is past the middle
// already may go anywhere.
template <class Real, int kCorners>
HYST_HD HYST_NOINLINE Real free_fraction(const Path<Real, kCorners>& path, const Obstacle3<Real>& obstacle) {
  if (path.stays_away(obstacle)) return 1;
  const Real distance = path.distance_at(obstacle, Real(0)), deep = distance < 0 ? -distance : Real(0);
  if (!(deep < obstacle.thinnest)) return 1;
  return fraction_above(path, obstacle, distance, (deep + obstacle.thinnest) / 2);
}

// Returns the fraction on which the point does not come within `rest_distance` [m], where the obstacle blocks
// the path; 1 where it does not.
template <class Real, int kCorners>
HYST_HD Real clipped_fraction(const Path<Real, kCorners>& path, const Obstacle3<Real>& obstacle,
                              Real rest_distance) {
  if (!(free_fraction(path, obstacle) < 1)) return 1;
  return fraction_above(path, obstacle, path.distance_at(obstacle, Real(0)), -rest_distance);
}

// Can a contact point that was at `start` be at `end` without having gone through an obstacle?
template <class Real, class Points>
HYST_HD bool path_is_clear(const Points& points, int point, const Vec3<Real>* start, const Vec3<Real>* end) {
  for (int o = 0; o < points.set.count; ++o) {
    if (!points.may_be_blocked_by(o)) continue;
    const Obstacle3<Real>& obstacle = points.set.item[o];
    if (free_fraction(path_beside(obstacle, points, point, start, end), obstacle) < 1) return false;
  }
  return true;
}

// Ends a vertex's path where it comes within `rest_distance` [m] of an obstacle that blocks it.
template <class Real>
HYST_HD void clip_path(const VertexPoints<Real>& vertices, int i, const Vec3<Real>* start, Vec3<Real>* end,
                       Real rest_distance) {
  for (int o = 0; o < vertices.set.count; ++o) {
    if (!vertices.may_be_blocked_by(o)) continue;
    const Obstacle3<Real>& obstacle = vertices.set.item[o];
    const Path<Real, 1> path = path_beside<Real>(obstacle, vertices, i, start, end);
    const Real own = clipped_fraction(path, obstacle, rest_distance);
    if (own < 1) end[i] = path.from[0] + own * path.displacement[0];
  }
}

}  // namespace hysteron
