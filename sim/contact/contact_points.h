// The points of the cloth that touch obstacles: vertices, and triangles at their point nearest to an obstacle
// that is sharper than the mesh.  Either moves with its corners by barycentric weights, which for a vertex is
// one weight of 1; its force is spread over them alike.
#pragma once

#include "sim/contact/face_touch.h"
#include "sim/contact/friction_stops.h"
#include "sim/contact/obstacle_set.h"

namespace hysteron {

// One vertex within the activation distance of one obstacle, or of the body that the obstacle is part of;
// like FaceTouch for triangles.
template <class Real>
struct VertexTouch {
  double energy = 0;              // [J]
  Real force = 0, stiffness = 0;  // [N], [N/m], by the distance
  Vec3<Real> direction;           // gradient of the distance, along the force
  Vec3<Real> outward;             // unit vector along it
  Real limit = 0;                 // force, times the coefficient of friction [N]
  int nearest = 0;                // index of the nearest obstacle in the set
  bool inside = false;            // true inside the solid

  HYST_HD bool is_active() const { return force > 0; }
  HYST_HD Vec3<Real> normal() const { return outward; }
  HYST_HD int obstacle(int) const { return nearest; }
  HYST_HD Real weight_of(int) const { return 1; }
  HYST_HD Vec3<Real> on_corner(int) const { return force * direction; }
};

inline constexpr double kBlend = 2;  // width over which bodies' members are blended, over the thickness

// Computes the touch with the body of the obstacle `o`, the first of its members.
template <class Real>
HYST_HD VertexTouch<Real> vertex_touch(const ObstacleSet<Real>& set, int o, const ContactModel<Real>& model,
                                       const Vec3<Real>& x, Real area) {
  VertexTouch<Real> touch;
  const BodyDistance<Real> d =
      distance_to_body(set, o, x, static_cast<Real>(kBlend) * model.response.thickness);
  if (!(d.value < model.response.thickness)) return touch;
  const Barrier<Real> b = model.response.at(d.value);
  touch.energy = static_cast<double>(area * b.energy);
  touch.force = -area * b.slope;
  touch.stiffness = area * b.stiffness;
  touch.direction = touch.outward = d.gradient;
  touch.nearest = d.nearest;
  touch.limit = set.item[d.nearest].friction * touch.force;
  touch.inside = d.value < 0;
  if (!d.joins) return touch;
  const Real steepness = d.gradient.norm();
  if (steepness > 0) touch.outward /= steepness;
  touch.limit *= steepness;
  return touch;
}

// Sums up the forces of all obstacles on one contact point.
template <class Real, int kCorners>
struct ActiveContacts {
  double energy = 0;                          // of their barriers [J]
  Vec3<Real> force[kCorners];                 // on each corner [N]
  Mat3<Real> stiffness = Mat3<Real>::Zero();  // of the barriers at the points [N/m]
  bool inside = false;                        // true inside a solid
  // The following describe the obstacle that presses most.
  int index = -1;  // in the scene; -1: none
  Real limit = 0;  // limit of friction [N]
  Vec3<Real> normal = Vec3<Real>::Zero();
  Vec3<Real> motion = Vec3<Real>::Zero();  // motion of the obstacle's point over the step [m]
  Vec<Real, kCorners> weight = Vec<Real, kCorners>::Zero();  // weights of the corners
};

template <class Real, class Points>
HYST_HD HYST_NOINLINE ActiveContacts<Real, Points::kCorners> active_contacts(const Points& points, int point,
                                                                             const Vec3<Real>* x) {
  constexpr int kCorners = Points::kCorners;
  ActiveContacts<Real, kCorners> all;
  for (Vec3<Real>& force : all.force) force.setZero();
  Real strongest = 0;
  for (int o = 0; o < points.set.count; ++o) {
    if (!points.feels(o)) continue;
    const auto t = points.touch(point, o, x);
    all.inside |= t.inside;
    if (!t.is_active()) continue;
    all.energy += t.energy;
    all.stiffness += t.stiffness * t.direction * t.direction.transpose();
    for (int k = 0; k < kCorners; ++k) all.force[k] += t.on_corner(k);
    if (!(t.force > strongest)) continue;
    strongest = t.force;
    const Obstacle3<Real>& obstacle = points.set.item[t.obstacle(o)];
    all.index = obstacle.index;
    all.limit = t.limit;
    all.normal = t.normal();
    Vec3<Real> at = Vec3<Real>::Zero();
    for (int k = 0; k < kCorners; ++k) {
      all.weight[k] = t.weight_of(k);
      at += all.weight[k] * x[points.vertex(point, k)];
    }
    all.motion = motion_over_step(obstacle, at);
  }
  return all;
}

// Returns the stretch of a point's stop [m], with its friction as fixed by update_lagged_friction().
template <class Real, class Points>
HYST_HD Vec3<Real> lagged_slip(const Points& points, int point, const typename Points::Friction& friction,
                               const Vec3<Real>* x, const Vec3<Real>* before) {
  Vec3<Real> e = friction.start;
  for (int k = 0; k < Points::kCorners; ++k) {
    const int v = points.vertex(point, k);
    e += friction.weight_of(k) * (x[v] - before[v]);
  }
  return e - friction.normal * friction.normal.dot(e);
}

template <class Points>
HYST_HD bool is_held(const Points& points, int point, const char* held) {
  for (int k = 0; k < Points::kCorners; ++k)
    if (held[points.vertex(point, k)]) return true;
  return false;
}

// All vertices against all obstacles; travels with a kernel launch by value.
template <class Real>
struct VertexPoints {
  static constexpr int kCorners = 1;
  using Friction = LaggedFriction<Real>;

  ContactModel<Real> model;
  ObstacleSet<Real> set;
  const Real* area;  // n areas [m^2]
  // Flags of n vertices that may be in solids while they are held.
  const char* exempted;

  HYST_HD int vertex(int i, int) const { return i; }
  HYST_HD bool feels(int obstacle) const { return set.item[obstacle].body == obstacle; }
  HYST_HD bool may_be_blocked_by(int obstacle) const { return set.item[obstacle].is_thin(); }
  HYST_HD bool may_be_inside(int i, const char* held) const { return held[i] && exempted[i]; }
  HYST_HD VertexTouch<Real> touch(int i, int obstacle, const Vec3<Real>* x) const {
    return vertex_touch(set, obstacle, model, x[i], area[i]);
  }
  // Fixes friction against the obstacle that presses most, for update_lagged_friction().
  HYST_HD Friction friction(int i, const ActiveContacts<Real, 1>& b, const StopView<Real>& stops) const {
    Friction friction{b.normal, -b.motion, b.limit};
    if (stops.goes_on(i, b.index)) friction.start += stops.slip[i];
    return friction;
  }
  // Returns the slip of the stop over the step that ends at x.
  HYST_HD Slip<Real> slip(int i, const ActiveContacts<Real, 1>& b, const Vec3<Real>* x,
                          const Vec3<Real>* before, const StopView<Real>& stops) const {
    Vec3<Real> e = x[i] - before[i] - b.motion;
    if (stops.goes_on(i, b.index)) e += stops.slip[i];
    e -= b.normal * b.normal.dot(e);
    return slip_within<Real>(e, b.limit, model.stop_stiffness(b.limit, area[i]));
  }
  // Adds the forces of evaluate() to the gradient [N].
  HYST_HD void give(int i, const Vec3<Real>* pressed, const Friction& friction, const Vec3<Real>& back,
                    Vec3<Real>* gradient) const {
    gradient[i] -= pressed[0];
    if (friction.limit > 0) gradient[i] += back;
  }
};

// Friction at a triangle's nearest point.
template <class Real>
struct FaceFriction : LaggedFriction<Real> {
  Vec3<Real> weight;
  int index;  // of the obstacle in the scene; -1: none

  HYST_HD Real weight_of(int corner) const { return weight[corner]; }
};

// All triangles against all obstacles that are sharper than the mesh; travels with a kernel launch by value.
template <class Real>
struct FacePoints {
  static constexpr int kCorners = 3;
  using Friction = FaceFriction<Real>;

  ContactModel<Real> model;
  ObstacleSet<Real> set;
  const Real* area;
  Real sharp;  // radius of curvature below which an obstacle is sharper [m]
  const Eigen::Vector3i* corner;

  HYST_HD int vertex(int f, int k) const { return corner[f][k]; }
  HYST_HD bool feels(int obstacle) const { return set.item[obstacle].sharpest < sharp; }
  HYST_HD bool may_be_blocked_by(int obstacle) const { return feels(obstacle); }
  HYST_HD bool may_be_inside(int f, const char* held) const { return is_held(*this, f, held); }
  HYST_HD FaceTouch<Real> touch(int f, int obstacle, const Vec3<Real>* x) const {
    const Vec3<Real> at[3] = {x[corner[f][0]], x[corner[f][1]], x[corner[f][2]]};
    return face_touch(set.item[obstacle], model, at, area[f]);
  }
  HYST_HD Friction friction(int f, const ActiveContacts<Real, 3>& b, const StopView<Real>& stops) const {
    Friction friction{{b.normal, -b.motion, b.limit}, b.weight, b.index};
    if (stops.goes_on(f, b.index)) friction.start += stops.slip[f];
    return friction;
  }
  HYST_HD Slip<Real> slip(int f, const ActiveContacts<Real, 3>& b, const Vec3<Real>* x,
                          const Vec3<Real>* before, const StopView<Real>& stops) const {
    const Vec3<Real> e = lagged_slip(*this, f, friction(f, b, stops), x, before);
    return slip_within<Real>(e, b.limit, model.stop_stiffness(b.limit, area[f]));
  }
  // Stores the forces of evaluate() on the corners [N], three for each triangle.
  HYST_HD void give(int f, const Vec3<Real>* pressed, const Friction& friction, const Vec3<Real>& back,
                    Vec3<Real>* force) const {
    for (int k = 0; k < 3; ++k) {
      force[3 * f + k] = pressed[k];
      if (friction.limit > 0) force[3 * f + k] -= friction.weight[k] * back;
    }
  }
};

}  // namespace hysteron
