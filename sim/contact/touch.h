// One vertex against all obstacles: the force of its shell, and the stop of friction in its tangent plane.
#pragma once

#include "sim/contact/contact.h"

namespace hysteron {

// Way of a point of an obstacle at x over the step [m].
template <class Real>
HYST_HD Vec3<Real> motion_over_step(const Obstacle3<Real>& obstacle, const Vec3<Real>& x) {
  return x - (obstacle.back_rotation * x + obstacle.back_translation);
}

// That of the scene's obstacle `index`; zero where it is not there.
template <class Real>
HYST_HD Vec3<Real> motion_of(const ObstacleSet<Real>& set, int index, const Vec3<Real>& x) {
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

// Trial slip, the share of it that friction can hold, and the stiffness of the stop [N/m].
template <class Real>
struct Slip {
  Vec3<Real> trial;
  Real share, stiffness;
};

template <class Real>
HYST_HD Slip<Real> slip(const Touch<Real>& t, const ContactModel<Real>& model, Real area,
                        const Vec3<Real>& moved, const Vec3<Real>& before, int touching) {
  Vec3<Real> e = moved - t.obstacle_motion;
  if (touching == t.index + 1) e += before;
  e -= t.normal * t.normal.dot(e);
  const Real limit = t.friction * t.strongest, k = model.stop_stiffness(limit, area), length = e.norm();
  return {e, k * length > limit ? limit / (k * length) : Real(1), k};
}

}  // namespace hysteron
