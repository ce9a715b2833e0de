// One vertex against all obstacles: the force of its shell, and the stop of friction in its tangent plane.
#pragma once

#include "sim/contact/friction_stops.h"
#include "sim/contact/obstacle_set.h"

namespace hysteron {

// Way of a point of an obstacle at x over the step [m].
template <class Real>
HYST_HD Vec3<Real> motion_over_step(const Obstacle3<Real>& obstacle, const Vec3<Real>& x) {
  return x - (obstacle.back_rotation * x + obstacle.back_translation);
}

// That of the scene's obstacle `index`; zero where it is not there.
template <class Real>
HYST_HD Vec3<Real> surface_motion(const ObstacleSet<Real>& set, int index, const Vec3<Real>& x) {
  for (int o = 0; o < set.count; ++o)
    if (set.item[o].index == index) return motion_over_step(set.item[o], x);
  return Vec3<Real>::Zero();
}

// Everything about one vertex in contact.
template <class Real>
struct Touch {
  Vec3<Real> normal_force = Vec3<Real>::Zero();  // sum over obstacles [N]
  Mat3<Real> normal_stiffness = Mat3<Real>::Zero();
  double energy = 0;                                // of the shells [J]
  Vec3<Real> obstacle_motion = Vec3<Real>::Zero();  // of the strongest obstacle's point over the step [m]
  Vec3<Real> normal = Vec3<Real>::Zero();
  Real strongest = 0, friction = 0;  // largest normal force [N], its coefficient
  int index = -1;
  bool inside = false;  // of a solid
};

template <class Real>
HYST_HD HYST_NOINLINE Touch<Real> touch(const ObstacleSet<Real>& set, const ContactModel<Real>& model,
                                        const Vec3<Real>& x, Real area) {
  Touch<Real> t;
  for (int o = 0; o < set.count; ++o) {
    const Obstacle3<Real>& obstacle = set.item[o];
    const Distance<Real> d = distance_to(obstacle, x);
    if (!(d.value < model.shell.thickness)) continue;
    const Vec3<Real> n = obstacle.rotation * d.normal;
    const Barrier<Real> b = model.shell.at(d.value);
    const Real force = -area * b.slope;
    t.normal_force += force * n;
    t.normal_stiffness += area * b.stiffness * n * n.transpose();
    t.energy += static_cast<double>(area * b.energy);
    t.inside |= d.value < 0;
    if (force > t.strongest) {
      t.strongest = force;
      t.friction = obstacle.friction;
      t.normal = n;
      t.index = obstacle.index;
      t.obstacle_motion = motion_over_step(obstacle, x);
    }
  }
  return t;
}

// Vertices against all obstacles; travels with a kernel launch by value.
template <class Real>
struct VertexContact {
  ContactModel<Real> model;
  ObstacleSet<Real> set;
  const Real* area;

  HYST_HD Touch<Real> vertex_touch(int i, const Vec3<Real>* x) const {
    return touch(set, model, x[i], area[i]);
  }
  // Of a vertex that has moved by `moved` over the step.
  HYST_HD Slip<Real> vertex_slip(int i, const Touch<Real>& t, const Vec3<Real>& moved,
                                 const StopView<Real>& stops) const {
    Vec3<Real> e = moved - t.obstacle_motion;
    if (stops.touching[i] == t.index + 1) e += stops.slip[i];
    e -= t.normal * t.normal.dot(e);
    const Real limit = t.friction * t.strongest;
    return slip_within<Real>(e, limit, model.stop_stiffness(limit, area[i]));
  }
};

}  // namespace hysteron
