// Computes one triangle against one obstacle that is sharper than the mesh, beyond what its corners feel.
//
// With B the barrier's energy per area at the nearest point and V_k those at the corners,
//
//   E = A/6 B prod_k (1 - V_k/B)_+^2
//
// Where a corner is the nearest point, as on anything flat, E = 0: the corners carry all force, and nothing
// is counted twice.  Where no corner is within the activation distance, the point carries the barrier's
// pressure on half of a corner's share of the area.  E has a gradient everywhere outside the solid, and never
// attracts a corner by more than the corner's own barrier repels it.  Stiffness is Gauss-Newton's, of the
// point's distance alone.
#pragma once

#include "sim/contact/compression.h"
#include "sim/contact/obstacle_set.h"
#include "sim/contact/signed_distance.h"

namespace hysteron {

// The point of a triangle that is nearest to a convex solid (Macklin, Erleben, Mueller, Chentanez, Jeschke &
// Corse 2020, "Local optimization for robust signed distance field collision").
//
//   d = min over w of  phi(sum w_k p_k) + c |w - 1/3|^2,   w_k >= 0, sum w_k = 1
//
// phi, the signed distance of a convex solid, is convex, so that the minimum is one of nested convex
// functions of one variable.  c > 0 makes the point unique where the solid's edge or side runs along the
// triangle: it then moves on without jumps, and d has a gradient, w_k n at corner k (envelope theorem).
template <class Real>
struct FacePoint {
  Vec3<Real> weight;
  Real distance;      // d [m]
  Vec3<Real> normal;  // gradient of phi; at a kink of phi, the mean of both sides' that keeps the point
};

// The slope of a convex function, with the values it was found from.
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

// Finds where in [0, 1] a convex function is least: the zero of its slope, by regula falsi (Illinois) with
// bisections.
template <class Real, class SlopeAt>
HYST_HD Lowest<Real> lowest(const SlopeAt& slope_at) {
  constexpr int kMaxCuts = 60;
  constexpr Real kFlat = sizeof(Real) == 8 ? Real(1e-11) : Real(1e-5);  // relative to the slopes' difference
  constexpr Real kNarrow = sizeof(Real) == 8 ? Real(1e-13) : Real(1e-6);
  Incline<Real> low = slope_at(Real(0));
  if (!(low.slope < 0)) return {0, low.normal, low.inner};
  Incline<Real> high = slope_at(Real(1));
  if (!(high.slope > 0)) return {1, high.normal, high.inner};
  const Real enough = kFlat * (high.slope - low.slope);
  Real a = 0, b = 1, at_a = low.slope, at_b = high.slope;
  int side = 0;
  for (int k = 0; k < kMaxCuts && b - a > kNarrow; ++k) {
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
  const Real fraction = low.slope / (low.slope - high.slope);  // at a kink the slopes of both sides cancel
  return {a + fraction * (b - a), low.normal + fraction * (high.normal - low.normal),
          low.inner + fraction * (high.inner - low.inner)};
}

// Returns the signed distance.  The slopes of nested minima use it in a dozen places, which call it, since a
// GPU's compiler would take longest for inlined copies.
template <class Real>
HYST_HD HYST_CALLED Distance<Real> distance_at(const Shape<Real>& shape, const Vec3<Real>& p) {
  return signed_distance(shape, p);
}

// Finds the point for corners p in the solid's frame; `centring` is c [m].
template <class Real>
HYST_HD HYST_NOINLINE FacePoint<Real> face_point(const Shape<Real>& shape, const Vec3<Real> (&p)[3],
                                                 Real centring) {
  const Vec3<Real> p0 = p[0], p1 = p[1], p2 = p[2];
  const Lowest<Real> found = lowest<Real>([&](Real a) {
    const Real remainder = 1 - a;
    const Lowest<Real> across = lowest<Real>([&](Real t) {
      const Vec3<Real> at = a * p0 + remainder * ((1 - t) * p1 + t * p2);
      const Vec3<Real> n = distance_at(shape, at).normal;
      return Incline<Real>{n.dot(p2 - p1) + 2 * centring * remainder * (2 * t - 1), n, t};
    });
    const Real t = across.at;
    const Real centre = a - remainder * ((1 - t) * (1 - t) + t * t);
    return Incline<Real>{across.normal.dot(p0 - (1 - t) * p1 - t * p2) + 2 * centring * centre, across.normal,
                         t};
  });
  const Real remainder = 1 - found.at;
  FacePoint<Real> point;
  point.weight = {found.at, remainder * (1 - found.inner), remainder * found.inner};
  const Vec3<Real> at = point.weight[0] * p0 + point.weight[1] * p1 + point.weight[2] * p2;
  point.distance = distance_at(shape, at).value + centring * (point.weight.squaredNorm() - Real(1) / Real(3));
  point.normal = found.normal;
  return point;
}

// Returns a bound below which no point of the triangle is near to a convex solid [m].
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

inline constexpr double kFaceFraction = 1.0 / 6;  // share of a triangle's area
inline constexpr double kCentring = 0.1;          // c of face_point(), over the thickness

template <class Real>
struct FaceTouch {
  double energy = 0;              // [J]
  Real force = 0, stiffness = 0;  // at the point, by its distance [N], [N/m]
  Vec3<Real> weight, direction;   // of the point; gradient of its distance
  Vec3<Real> pull[3];             // on the corners, towards the obstacle [N]
  Real limit = 0;                 // net force, times the coefficient of friction [N]
  bool inside = false;

  HYST_HD bool is_active() const { return force > 0; }
  HYST_HD Vec3<Real> normal() const { return direction.normalized(); }
  HYST_HD Real weight_of(int k) const { return weight[k]; }
  HYST_HD int obstacle(int touched) const { return touched; }
  HYST_HD Vec3<Real> on_corner(int k) const { return force * weight[k] * direction + pull[k]; }
};

template <class Real>
HYST_HD HYST_NOINLINE FaceTouch<Real> face_touch(const Obstacle3<Real>& obstacle,
                                                 const ContactModel<Real>& model, const Vec3<Real> (&x)[3],
                                                 Real area) {
  FaceTouch<Real> touch;
  const Real thickness = model.response.thickness;
  Vec3<Real> p[3];
  for (int k = 0; k < 3; ++k) p[k] = obstacle.rotation.transpose() * (x[k] - obstacle.center);
  if (!(least_possible(obstacle.shape, p) < thickness)) return touch;
  Distance<Real> corner[3];
  int first = 0;
  for (int k = 0; k < 3; ++k) {
    corner[k] = signed_distance(obstacle.shape, p[k]);
    if (corner[k].value < corner[first].value) first = k;
  }
  bool corner_is_nearest = true;
  for (int k = 0; k < 3; ++k)
    if (corner[first].normal.dot(p[k] - p[first]) < 0) corner_is_nearest = false;
  if (corner_is_nearest) return touch;
  const FacePoint<Real> point = face_point<Real>(obstacle.shape, p, static_cast<Real>(kCentring) * thickness);
  if (!(point.distance < thickness)) return touch;
  const Barrier<Real> b = model.response.at(point.distance);
  Real left = 1, sum = 0, curved = 0, slope[3], of_b[3];
  for (int k = 0; k < 3; ++k) {
    slope[k] = of_b[k] = 0;
    if (corner[k].value < thickness) {
      const Barrier<Real> v = model.response.at(corner[k].value);
      of_b[k] = v.energy / b.energy;
      slope[k] = v.slope;
    }
    const Real remainder = 1 - of_b[k];
    if (!(remainder > 0)) return touch;
    left *= remainder;
    sum += of_b[k] / remainder;
    curved += of_b[k] * (2 - of_b[k]) / (remainder * remainder);
  }
  const Real fraction = static_cast<Real>(kFaceFraction) * area, factor = fraction * left * left;
  const Real first_order = 1 + 2 * sum,
             second_order = first_order * first_order - 1 - 2 * curved;  // by B, times B
  const Real hardening = factor * (b.stiffness * first_order + b.slope * b.slope / b.energy * second_order);
  touch.energy = static_cast<double>(factor * b.energy);
  touch.force = -factor * first_order * b.slope;
  touch.stiffness = hardening > 0 ? hardening : Real(0);
  touch.weight = point.weight;
  touch.direction = obstacle.rotation * point.normal;
  touch.inside = point.distance < 0;
  Real net = touch.force * point.normal.norm();
  for (int k = 0; k < 3; ++k) {
    const Real pulled = 2 * factor / (1 - of_b[k]) * slope[k];  // <= 0
    touch.pull[k] = pulled * (obstacle.rotation * corner[k].normal);
    net += pulled;
  }
  touch.limit = net > 0 ? obstacle.friction * net : Real(0);
  return touch;
}

}  // namespace hysteron
