// Sharp obstacles that triangles, or they themselves, would pass through in one step.  No point of a triangle
// goes farther than the corner that goes farthest, so that the triangle's distance can be followed as a
// vertex's is (sweep.h).
#include "sim/contact/face_contact.h"
#include "sim/contact/sweep.h"

namespace hysteron {

namespace {

template <class Real>
struct FacePath {
  Vec3<Real> from[3], displacement[3];

  HYST_HD Real length() const {
    Real longest = 0;
    for (const Vec3<Real>& w : displacement) longest = w.norm() > longest ? w.norm() : longest;
    return longest;
  }
  HYST_HD void place(const Obstacle3<Real>& obstacle, Real fraction, Vec3<Real> (&p)[3]) const {
    for (int k = 0; k < 3; ++k)
      p[k] = obstacle.rotation.transpose() * (from[k] + fraction * displacement[k] - obstacle.center);
  }
  HYST_HD Real distance_at(const Obstacle3<Real>& obstacle, Real fraction) const {
    Vec3<Real> p[3];
    place(obstacle, fraction, p);
    return face_point<Real>(obstacle.shape, p, Real(0)).distance;
  }
  HYST_HD bool stays_away(const Obstacle3<Real>& obstacle) const {
    Vec3<Real> p[3];
    place(obstacle, Real(0), p);
    return least_possible(obstacle.shape, p) > length();
  }
};

// The path beside the obstacle; of one at rest `start` itself is where it begins.
template <class Real>
HYST_HD FacePath<Real> path_beside(const Obstacle3<Real>& obstacle, const Eigen::Vector3i& face,
                                   const Vec3<Real>* start, const Vec3<Real>* end) {
  FacePath<Real> path;
  for (int k = 0; k < 3; ++k) {
    path.from[k] = carried(obstacle, start[face[k]]);
    path.displacement[k] = end[face[k]] - path.from[k];
  }
  return path;
}

template <class Real>
HYST_HD Real fraction_before(const FacePath<Real>& path, const Obstacle3<Real>& obstacle, Real distance,
                             Real depth) {
  return fraction_above<Real>(path.length(), distance, depth, obstacle.thinnest,
                              [&](Real fraction) { return path.distance_at(obstacle, fraction); });
}

// As free_fraction() of a vertex.
template <class Real>
HYST_HD HYST_NOINLINE Real free_fraction(const FacePath<Real>& path, const Obstacle3<Real>& obstacle) {
  if (path.stays_away(obstacle)) return 1;
  const Real distance = path.distance_at(obstacle, Real(0)), deep = distance < 0 ? -distance : Real(0);
  if (!(deep < obstacle.thinnest)) return 1;
  return fraction_before(path, obstacle, distance, (deep + obstacle.thinnest) / 2);
}

HYST_HD inline bool any_held(const Eigen::Vector3i& face, const char* held) {
  return held[face[0]] || held[face[1]] || held[face[2]];
}

}  // namespace

// Corners go the least share of their triangles; where some then go farther than others and a triangle is
// barred again, the same once more, and at last they stay beside the obstacle.
template <class Real, class Device>
void FaceContact<Real, Device>::clip_to_obstacles(const ObstacleSet<Real>& set, const Vec3<Real>* start,
                                                  Vec3<Real>* end, const char* held, Real rest_distance) {
  constexpr int kRounds = 8, kShortened = 4;
  for (int o = 0; o < set.count; ++o) {
    if (!is_sharp(set.item[o])) continue;
    for (int round = 0; round < kRounds; ++round)
      if (end_before(set.item[o], start, end, held, rest_distance, round >= kShortened) == 1) break;
  }
}

// The least share of its way that a corner has kept.
template <class Real, class Device>
Real FaceContact<Real, Device>::end_before(const Obstacle3<Real>& in, const Vec3<Real>* start,
                                           Vec3<Real>* end, const char* held, Real rest_distance, bool stay) {
  const Obstacle3<Real> obstacle = in;
  const Eigen::Vector3i* corner = corner_.data();
  Real* fraction = fraction_.reserve(faces_);
  for_each(
      device_, "face contact: guess", faces_, HYST_KERNEL(int f) {
        fraction[f] = 1;
        if (any_held(corner[f], held)) return;
        const FacePath<Real> path = path_beside(obstacle, corner[f], start, end);
        if (!(free_fraction(path, obstacle) < 1)) return;
        fraction[f] =
            stay ? Real(0)
                 : fraction_before<Real>(path, obstacle, path.distance_at(obstacle, Real(0)), -rest_distance);
      });
  const Real least = smallest(device_, scratch_, fraction, faces_, Real(1));
  if (!(least < 1)) return 1;
  const int *first = vertex_start_.data(), *item = vertex_item_.data();
  for_each(
      device_, "face contact: shortened", vertices_, HYST_KERNEL(int i) {
        Real own = 1;
        for (int j = first[i]; j < first[i + 1]; ++j)
          own = fraction[item[j] / 3] < own ? fraction[item[j] / 3] : own;
        if (!(own < 1)) return;
        const Vec3<Real> from = carried(obstacle, start[i]);
        end[i] = from + own * (end[i] - from);
      });
  return least;
}

template <class Real, class Device>
bool FaceContact<Real, Device>::path_is_clear(const ObstacleSet<Real>& set, const Vec3<Real>* start,
                                              const Vec3<Real>* end, const char* held) {
  const FaceView<Real> faces = view(set);
  Real* fraction = fraction_.reserve(faces_);
  for_each(
      device_, "face contact: reached", faces_, HYST_KERNEL(int f) {
        fraction[f] = 1;
        if (any_held(faces.corner[f], held)) return;
        for (int o = 0; o < faces.set.count; ++o) {
          if (!faces.feels(o)) continue;
          const FacePath<Real> path = path_beside(faces.set.item[o], faces.corner[f], start, end);
          if (free_fraction(path, faces.set.item[o]) < 1) fraction[f] = 0;
        }
      });
  return smallest(device_, scratch_, fraction, faces_, Real(1)) > 0;
}

template <class Real, class Device>
double FaceContact<Real, Device>::feasible_step(const ObstacleSet<Real>& set, const Vec3<Real>* x,
                                                const Vec3<Real>* direction, const char* held,
                                                double max_step) {
  const FaceView<Real> faces = view(set);
  const Real requested = static_cast<Real>(max_step);
  Real* fraction = fraction_.reserve(faces_);
  for_each(
      device_, "face contact: collisions", faces_, HYST_KERNEL(int f) {
        fraction[f] = 1;
        if (any_held(faces.corner[f], held)) return;
        FacePath<Real> path;
        faces.place(f, x, path.from);
        for (int k = 0; k < 3; ++k) path.displacement[k] = requested * direction[faces.corner[f][k]];
        for (int o = 0; o < faces.set.count; ++o) {
          if (!faces.feels(o)) continue;
          const Real free = free_fraction(path, faces.set.item[o]);
          fraction[f] = free < fraction[f] ? free : fraction[f];
        }
      });
  return max_step * static_cast<double>(smallest(device_, scratch_, fraction, faces_, Real(1)));
}

template class FaceContact<double, ThisDevice>;
template class FaceContact<float, ThisDevice>;

}  // namespace hysteron
