// The places of strains: triangles, or nodes (membrane_nodes.h), which have means along warp and weft and no
// shear.  Both have the same interface, so that stresses, friction, losses and energies are computed alike.
#pragma once

#include "sim/membrane/green_lagrange.h"

namespace hysteron {

// The triangles at rest, and their deformation where they were evaluated last.
template <class R>
struct FaceStrains {
  using Real = R;
  const MembraneRest<Real>* rest;
  const Eigen::Vector3i* corner;
  Deformation<Real>* deformed;

  HYST_HD Real area(int f) const { return rest[f].area; }
  // Returns the gradient of any vectors at vertices, such as positions or velocities.
  HYST_HD Deformation<Real> gradient(int f, const Vec3<Real>* x) const {
    const Eigen::Vector3i t = corner[f];
    return deformation(rest[f], x[t[0]], x[t[1]], x[t[2]]);
  }
  HYST_HD Vec3<Real> at(int f, const Vec3<Real>* x) const { return green_strain(gradient(f, x)); }
  // Returns the strain and stores the deformation.
  HYST_HD Vec3<Real> evaluate(int f, const Vec3<Real>* x) const {
    const Deformation<Real> d = gradient(f, x);
    deformed[f] = d;
    return green_strain(d);
  }
  HYST_HD Vec3<Real> evaluated(int f) const { return green_strain(deformed[f]); }
  // Returns (F1.F1, F2.F2, F1.F2).
  HYST_HD Vec3<Real> squares(int f, const Vec3<Real>* x) const {
    const Deformation<Real> d = gradient(f, x);
    return {d.f1.squaredNorm(), d.f2.squaredNorm(), d.f1.dot(d.f2)};
  }
  // Returns the strain rate of these velocities, where the triangle was evaluated.
  HYST_HD Vec3<Real> rate(int f, const Vec3<Real>* v) const {
    return green_strain_rate(deformed[f], gradient(f, v));
  }
};

template <class R>
struct NodeStrains {
  using Real = R;
  FaceStrains<Real> faces;
  const int *start, *item;    // rows: nodes; items: 3*face + corner
  const Real *weight, *size;  // A_f/(3 A_v) per item, A_v per node [m^2]

  HYST_HD Real area(int n) const { return size[n]; }
  template <class OfFace>
  HYST_HD Vec3<Real> mean(int n, const OfFace& of_face) const {
    Vec3<Real> sum = Vec3<Real>::Zero();
    for (int j = start[n]; j < start[n + 1]; ++j) {
      const Vec3<Real> strain = of_face(item[j] / 3);
      sum[0] += weight[j] * strain[0];
      sum[1] += weight[j] * strain[1];
    }
    return sum;
  }
  HYST_HD Vec3<Real> at(int n, const Vec3<Real>* x) const {
    return mean(n, [&](int f) { return faces.at(f, x); });
  }
  HYST_HD Vec3<Real> squares(int n, const Vec3<Real>* x) const {  // means, too
    Vec3<Real> sum = Vec3<Real>::Zero();
    for (int j = start[n]; j < start[n + 1]; ++j) sum += weight[j] * faces.squares(item[j] / 3, x);
    return sum;
  }
  // Its triangles come first.
  HYST_HD Vec3<Real> evaluate(int n, const Vec3<Real>*) const { return evaluated(n); }
  HYST_HD Vec3<Real> evaluated(int n) const {
    return mean(n, [&](int f) { return faces.evaluated(f); });
  }
  HYST_HD Vec3<Real> rate(int n, const Vec3<Real>* v) const {
    return mean(n, [&](int f) { return faces.rate(f, v); });
  }
};

}  // namespace hysteron
