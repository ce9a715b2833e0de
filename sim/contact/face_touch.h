// One triangle against one obstacle that is sharper than the mesh: what its corners do not feel.
//
// With B the shell's energy per area at the nearest point and V_k those at the corners,
//
//   E = A/6 B prod_k (1 - V_k/B)_+^2
//
// Where a corner is the nearest point, as on anything flat, E = 0: corners bear alone, and nothing is counted
// twice.  Where none of them is in the shell, the point bears with the shell's pressure on half of a corner's
// share of the area.  E has a gradient everywhere outside the solid, and never attracts a corner by more than
// the corner's own shell repels it.  Stiffness is Gauss-Newton's, of the point's distance alone.
#pragma once

#include "sim/contact/contact_model.h"
#include "sim/contact/face_point.h"
#include "sim/contact/obstacle_set.h"

namespace hysteron {

inline constexpr double kFaceShare = 1.0 / 6;  // of a triangle's area
inline constexpr double kCentring = 0.1;       // c of face_point.h, over the thickness

template <class Real>
struct FaceTouch {
  double energy = 0;              // [J]
  Real force = 0, stiffness = 0;  // at the point, by its distance [N], [N/m]
  Vec3<Real> weight, direction;   // of the point; gradient of its distance
  Vec3<Real> pull[3];             // on the corners, towards the obstacle [N]
  Real limit = 0;                 // net force, times the coefficient of friction [N]
  bool inside = false;

  HYST_HD bool bears() const { return force > 0; }
  HYST_HD Vec3<Real> on_corner(int k) const { return force * weight[k] * direction + pull[k]; }
};

template <class Real>
HYST_HD HYST_NOINLINE FaceTouch<Real> face_touch(const Obstacle3<Real>& obstacle,
                                                 const ContactModel<Real>& model, const Vec3<Real> (&x)[3],
                                                 Real area) {
  FaceTouch<Real> touch;
  const Real thickness = model.shell.thickness;
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
  const Barrier<Real> b = model.shell.at(point.distance);
  Real left = 1, sum = 0, curved = 0, slope[3], of_b[3];
  for (int k = 0; k < 3; ++k) {
    slope[k] = of_b[k] = 0;
    if (corner[k].value < thickness) {
      const Barrier<Real> v = model.shell.at(corner[k].value);
      of_b[k] = v.energy / b.energy;
      slope[k] = v.slope;
    }
    const Real rest = 1 - of_b[k];
    if (!(rest > 0)) return touch;
    left *= rest;
    sum += of_b[k] / rest;
    curved += of_b[k] * (2 - of_b[k]) / (rest * rest);
  }
  const Real share = static_cast<Real>(kFaceShare) * area, factor = share * left * left;
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
