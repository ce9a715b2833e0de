// Computes one pair of cloth parts: its distance, the barrier's force, the stop of friction.
#pragma once

#include "sim/contact/additive_ccd.h"
#include "sim/contact/compression.h"
#include "sim/contact/self_pairs.h"
#include "sim/linear/pair_product.h"

namespace hysteron {

template <class Real>
struct SelfContactModel {
  Real stiffness, friction, slip;  // [N/m^3], Coulomb coefficient, [m]
};

template <class Real>
struct PairFriction {
  Vec3<Real> slip, normal;  // elastic slip at the start of the step [m]; the rest is of the lagged contact
  Vec<Real, 4> weight;
  Real limit;  // mu f_n [N]; 0: no contact
};

// The entries of pairs with friction among those of all (PairRows): a vertex's begin where all its entries
// do, and end earlier.
struct RubbingRows {
  const int *start, *end, *item;
};

inline constexpr double kClosest = 0.1;    // share of the activation distance that no step goes below
inline constexpr double kLast = 0.2;       // share below which a second barrier protects that
inline constexpr double kLastStiff = 3e3;  // stiffness of the second barrier over the first's

template <class Real>
HYST_HD Real least_distance(const SelfPair<Real>& pair) {
  return static_cast<Real>(kClosest) * pair.activation_distance;
}

// Returns the barrier of a pair at this distance, below its activation distance.  That of neighbours on the
// flat cloth is small, and their barrier is weak in proportion: a sharp fold of triangles finer than the
// thickness presses through it.  At the least distance no step could then lead anywhere, so that a second
// barrier ends a little above it.
template <class Real>
HYST_HD Barrier<Real> pair_barrier(const SelfPair<Real>& pair, Real k, Real distance) {
  const Real hardest = static_cast<Real>(kHardest) * pair.activation_distance,
             last = static_cast<Real>(kLast) * pair.activation_distance;
  const Barrier<Real> first = barrier(k, distance - hardest, pair.activation_distance - hardest);
  if (!(distance < last)) return first;
  const Real least = least_distance(pair);
  return first + barrier(static_cast<Real>(kLastStiff) * k, distance - least, last - least);
}

template <class Real>
struct SelfTouch {
  bool touches = false;
  Vec3<Real> normal;
  Vec<Real, 4> weight;
  double energy;             // [J]
  Real force, stiffness;     // [N], [N/m]
  Real fade_slope = 0;       // derivative of the energy by the squared cross product of the edges [J/m^4]
  Vec3<Real> first, second;  // the edges, where they are nearly parallel [m]
};

template <class Real>
HYST_HD HYST_NOINLINE SelfTouch<Real> self_touch(const SelfPair<Real>& pair,
                                                 const SelfContactModel<Real>& model,
                                                 const Vec3<Real>* position) {
  Vec3<Real> x[4];
  pair.gather(position, x);
  const ClosestPoints<Real> closest = pair.is_edges() ? edge_edge(x) : point_triangle(x);
  SelfTouch<Real> touch;
  const Real distance = closest.offset.norm();
  if (!(distance < pair.activation_distance)) return touch;
  touch.touches = true;
  touch.normal = closest.offset / distance;
  touch.weight = closest.weight;
  const Barrier<Real> b = pair_barrier(pair, model.stiffness, distance);
  Fade<Real> fade{1, 0};
  if (pair.is_edges()) {
    touch.first = x[1] - x[0];
    touch.second = x[3] - x[2];
    fade = parallel_fade(touch.first.cross(touch.second).squaredNorm(), pair.parallel);
    touch.fade_slope = fade.slope * pair.area * b.energy;
  }
  touch.energy = static_cast<double>(fade.factor * pair.area * b.energy);
  touch.force = -fade.factor * pair.area * b.slope;
  touch.stiffness = fade.factor * pair.area * b.stiffness;
  return touch;
}

// Are the figures of a pair at x edges so nearly parallel that their energy fades?
template <class Real>
HYST_HD bool are_fading(const SelfPair<Real>& pair, const Vec3<Real> (&x)[4]) {
  return (x[1] - x[0]).cross(x[3] - x[2]).squaredNorm() < pair.parallel;
}

// Returns the resistance of fading edges a and b to turning against each other.  With c = |a x b|^2 it is 2
// dE/dc J'J, the positive part of the fade's second derivative, where J is that of a x b; as b is nearly k a,
// J (da, db) = a x (db - k da).
template <class Real>
HYST_HD PairStiffness<Real> turning_stiffness(const SelfPair<Real>& pair, const SelfTouch<Real>& touch) {
  const Vec3<Real>& a = touch.first;
  const Real ratio = a.dot(touch.second) / a.squaredNorm();
  PairStiffness<Real> s;
  for (int k = 0; k < 4; ++k) s.v[k] = pair.v[k];
  s.weight << ratio, -ratio, -1, 1;
  s.block = 2 * touch.fade_slope * (a.squaredNorm() * Mat3<Real>::Identity() - a * a.transpose());
  return s;
}

// Returns the gradient of the barrier's energy by the pair's vertex k [N].
template <class Real>
HYST_HD Vec3<Real> barrier_gradient(const SelfTouch<Real>& touch, int k) {
  Vec3<Real> gradient = -touch.force * touch.weight[k] * touch.normal;
  if (touch.fade_slope != 0) {  // d|a x b|^2/da = 2 (a |b|^2 - (a.b) b)
    const Vec3<Real>&mine = k < 2 ? touch.first : touch.second, other = k < 2 ? touch.second : touch.first;
    const Vec3<Real> by_edge = 2 * (other.squaredNorm() * mine - mine.dot(other) * other);
    gradient += (k % 2 ? touch.fade_slope : -touch.fade_slope) * by_edge;
  }
  return gradient;
}

// Turns a stop's stretch with the tangent plane, keeping its length.
template <class Real>
HYST_HD Vec3<Real> turned_into_plane(const Vec3<Real>& slip, const Vec3<Real>& normal) {
  using std::sqrt;
  const Vec3<Real> flat = slip - normal * normal.dot(slip);
  const Real left = flat.squaredNorm(), all = slip.squaredNorm();
  return 4 * left > all ? Vec3<Real>(sqrt(all / left) * flat) : flat;
}

// Returns the tangential displacement since the stop was at rest [m].
template <class Real>
HYST_HD Vec3<Real> pair_slip(const SelfPair<Real>& pair, const PairFriction<Real>& friction,
                             const Vec3<Real>* position, const Vec3<Real>* before) {
  Vec3<Real> moved = Vec3<Real>::Zero();
  for (int k = 0; k < 4; ++k) moved += friction.weight[k] * (position[pair.v[k]] - before[pair.v[k]]);
  return turned_into_plane(friction.slip, friction.normal) + moved -
         friction.normal * friction.normal.dot(moved);
}

// Do the figures of p and q share vertices, first with first and second with second?
template <class Real>
HYST_HD bool are_neighbours(const SelfPair<Real>& p, const SelfPair<Real>& q, bool crosswise) {
  const int p_split = p.is_edges() ? 2 : 1, q_split = q.is_edges() ? 2 : 1;
  bool first = false, second = false;
  for (int k = 0; k < 4; ++k)
    for (int l = 0; l < 4; ++l) {
      if (p.v[k] != q.v[l] || ((k < p_split) == (l < q_split)) == crosswise) continue;
      (k < p_split ? first : second) = true;
    }
  return first && second;
}

// Returns the stretch of the stop with which a pair becomes active: the mean of its rubbing neighbours',
// weighted by their limits, so that a layer which rests or slides across an edge of another does not feel
// that edge.
template <class Real>
HYST_HD HYST_NOINLINE Vec3<Real> inherited_slip(const SelfPair<Real>& pair, const SelfPair<Real>* others,
                                                const PairFriction<Real>* friction, const RubbingRows& rows) {
  Vec3<Real> sum = Vec3<Real>::Zero();
  Real limits = 0, lengths = 0;
  for (int k = 0; k < (pair.is_edges() ? 2 : 1); ++k)
    for (int j = rows.start[pair.v[k]]; j < rows.end[pair.v[k]]; ++j) {
      const int q = rows.item[j] / 4;
      const Real limit = friction[q].limit;
      const bool same = are_neighbours(pair, others[q], false);
      if (!same && !are_neighbours(pair, others[q], true)) continue;
      sum += (same ? limit : -limit) * friction[q].slip;
      limits += limit;
      lengths += limit * friction[q].slip.norm();
    }
  const Real length = sum.norm();  // less than `lengths` where their planes differ
  return length > lengths / 2 ? Vec3<Real>(lengths / (limits * length) * sum)
                              : Vec3<Real>(Vec3<Real>::Zero());
}

}  // namespace hysteron
