// Computes signed distances of the obstacles: negative inside; the gradient is the outward unit normal.
#pragma once

#include <cmath>

#include "sim/device/host_device.h"
#include "sim/scene/obstacle_kind.h"

namespace hysteron {

// A shape in its own frame: ground is z <= 0, hollow all but a sphere; cylinder, capsule and torus lie along
// z, centred; the box is centred.
template <class Real>
struct Shape {
  ObstacleKind kind;
  Vec3<Real> half;  // box: half edges; else x = radius, z = half height of the axis [m]
  Real rim;         // rounding of the edges of cylinder and box [m]
};

template <class Real>
struct Distance {
  Real value;         // [m]
  Vec3<Real> normal;  // outward unit vector
};

// Returns the distance of a rounded corner in two or three dimensions: q is the position relative to the
// corner of the shrunken box.
template <class Real, int N>
HYST_HD inline Distance<Real> rounded_corner(const Vec<Real, N>& q, Real rim, Vec<Real, N>& normal) {
  Vec<Real, N> outside = q.cwiseMax(Real(0));
  const Real length = outside.norm();
  if (length > 0) {
    normal = outside / length;
    return {length - rim, {}};
  }
  int nearest = 0;
  for (int k = 1; k < N; ++k)
    if (q[k] > q[nearest]) nearest = k;
  normal = Vec<Real, N>::Unit(nearest);
  return {q[nearest] - rim, {}};
}

template <class Real>
HYST_HD inline Distance<Real> ground_distance(const Shape<Real>&, const Vec3<Real>& p) {
  return {p[2], Vec3<Real>::UnitZ()};
}

template <class Real>
HYST_HD inline Distance<Real> sphere_distance(const Shape<Real>& s, const Vec3<Real>& p) {
  const Real length = p.norm();
  return {length - s.half[0], length > 0 ? Vec3<Real>(p / length) : Vec3<Real>(Vec3<Real>::UnitZ())};
}

template <class Real>
HYST_HD inline Distance<Real> hollow_distance(const Shape<Real>& s, const Vec3<Real>& p) {
  const Distance<Real> d = sphere_distance(s, p);
  return {-d.value, -d.normal};
}

template <class Real>
HYST_HD inline Distance<Real> cylinder_distance(const Shape<Real>& s, const Vec3<Real>& p) {
  using std::sqrt;
  const Real r = sqrt(p[0] * p[0] + p[1] * p[1]);
  const Real sign = p[2] < 0 ? Real(-1) : Real(1);
  const Vec<Real, 2> q(r - s.half[0] + s.rim, sign * p[2] - s.half[2] + s.rim);
  Vec<Real, 2> n;
  Distance<Real> d = rounded_corner<Real, 2>(q, s.rim, n);
  const Vec3<Real> radial = r > 0 ? Vec3<Real>(p[0] / r, p[1] / r, 0) : Vec3<Real>(1, 0, 0);
  d.normal = n[0] * radial + Vec3<Real>(0, 0, sign * n[1]);
  return d;
}

template <class Real>
HYST_HD inline Distance<Real> box_distance(const Shape<Real>& s, const Vec3<Real>& p) {
  Vec3<Real> sign, q, n;
  for (int k = 0; k < 3; ++k) {
    sign[k] = p[k] < 0 ? Real(-1) : Real(1);
    q[k] = sign[k] * p[k] - s.half[k] + s.rim;
  }
  Distance<Real> d = rounded_corner<Real, 3>(q, s.rim, n);
  d.normal = n.cwiseProduct(sign);
  return d;
}

template <class Real>
HYST_HD inline Distance<Real> capsule_distance(const Shape<Real>& s, const Vec3<Real>& p) {
  const Real z = p[2] < -s.half[2] ? -s.half[2] : (p[2] > s.half[2] ? s.half[2] : p[2]);
  return sphere_distance(s, Vec3<Real>(p[0], p[1], p[2] - z));
}

// A torus is a ring around z: `half[0]` is the radius to the middle of its wire, whose radius is `half[2]`.
template <class Real>
HYST_HD inline Distance<Real> torus_distance(const Shape<Real>& s, const Vec3<Real>& p) {
  using std::sqrt;
  const Real r = sqrt(p[0] * p[0] + p[1] * p[1]);
  const Vec3<Real> radial = r > 0 ? Vec3<Real>(p[0] / r, p[1] / r, 0) : Vec3<Real>(1, 0, 0);
  const Vec3<Real> from_wire = p - s.half[0] * radial;
  const Real length = from_wire.norm();
  return {length - s.half[2], length > 0 ? Vec3<Real>(from_wire / length) : radial};
}

// A mesh is absent for these functions: the contact of its triangles is separate.
template <class Real>
HYST_HD inline Distance<Real> mesh_distance(const Shape<Real>&, const Vec3<Real>&) {
  return {static_cast<Real>(1e30), Vec3<Real>::UnitZ()};
}

template <class Real>
HYST_HD inline Distance<Real> signed_distance(const Shape<Real>& s, const Vec3<Real>& p) {
  switch (s.kind) {
#define HYST_OBSTACLE(kind, ...) \
  case ObstacleKind::kind:       \
    return kind##_distance(s, p);
#include "sim/scene/obstacle_kinds.def"
  }
  return {};
}

}  // namespace hysteron
