// Defines an orthotropic Green-Lagrange membrane on constant-strain triangles (Volino, Magnenat-Thalmann,
// Faure 2009; St.  Venant-Kirchhoff):
//
//   F = [F1 F2]: images of the warp and weft unit vectors;  E = (F^T F - I)/2 = (E11, E22, 2 E12)
//   energy per rest area W = (C11 E11^2 + 2 C12 E11 E22 + C22 E22^2 + G (2 E12)^2)/2
//   stress (S11, S22, S12) = (C11 E11 + C12 E22, C12 E11 + C22 E22, G 2E12)  [N/m]
//   force on corner i: -A (F1 (S11 b1 + S12 b2) + F2 (S12 b1 + S22 b2)), b = gradient of its shape function
//   [1/m]
#pragma once

#include <cmath>

#include "sim/device/host_device.h"

namespace hysteron {

template <class Real>
struct MembraneStiffness {
  Real warp, weft, coupling, shear;  // C11, C22, C12, G [N/m]
};

// The rest geometry of a face: its area and the shape functions' gradients in the warp-weft frame.
template <class Real>
struct MembraneRest {
  Real area;          // [m^2]
  Real b1[3], b2[3];  // d N_i / d warp, d N_i / d weft [1/m]
};

template <class Real>
struct MembraneStress {
  Real s11, s22, s12;  // second Piola-Kirchhoff, per unit width [N/m]
};

template <class Real>
struct Deformation {
  Vec3<Real> f1, f2;
};

template <class Real>
HYST_HD inline Deformation<Real> deformation(const MembraneRest<Real>& rest, const Vec3<Real>& x0,
                                             const Vec3<Real>& x1, const Vec3<Real>& x2) {
  const Vec3<Real> d1 = x1 - x0, d2 = x2 - x0;  // the gradients sum to zero
  return {rest.b1[1] * d1 + rest.b1[2] * d2, rest.b2[1] * d1 + rest.b2[2] * d2};
}

template <class Real>
HYST_HD inline Vec3<Real> green_strain(const Deformation<Real>& f) {  // returns (E11, E22, 2 E12)
  return {(f.f1.squaredNorm() - 1) / 2, (f.f2.squaredNorm() - 1) / 2, f.f1.dot(f.f2)};
}

// Returns the rate of the Green strain for velocity gradient g.
template <class Real>
HYST_HD inline Vec3<Real> green_strain_rate(const Deformation<Real>& f, const Deformation<Real>& g) {
  return {f.f1.dot(g.f1), f.f2.dot(g.f2), f.f1.dot(g.f2) + f.f2.dot(g.f1)};
}

template <class Real>
HYST_HD inline MembraneStress<Real> membrane_stress(const MembraneStiffness<Real>& c, const Vec3<Real>& e) {
  return {c.warp * e[0] + c.coupling * e[1], c.coupling * e[0] + c.weft * e[1], c.shear * e[2]};
}

template <class Real>
HYST_HD inline Real membrane_energy(const MembraneStiffness<Real>& c, const Vec3<Real>& e) {
  const MembraneStress<Real> s = membrane_stress(c, e);
  return (s.s11 * e[0] + s.s22 * e[1] + s.s12 * e[2]) / 2;
}

template <class Real>
HYST_HD inline Vec3<Real> membrane_force(const MembraneRest<Real>& rest, const Deformation<Real>& f,
                                         const MembraneStress<Real>& s, int corner) {
  const Real b1 = rest.b1[corner], b2 = rest.b2[corner];
  return -rest.area * ((s.s11 * b1 + s.s12 * b2) * f.f1 + (s.s12 * b1 + s.s22 * b2) * f.f2);
}

// Returns the nearest positive semidefinite 2x2 stress: the geometric term of compression is left out of the
// Hessian, so that the implicit matrix stays positive definite (Teran et al. 2005 in spirit; here exact, the
// geometric term is S x I).
template <class Real>
HYST_HD inline MembraneStress<Real> tensile_part(const MembraneStress<Real>& s) {
  using std::sqrt;
  const Real mean = (s.s11 + s.s22) / 2, half = (s.s11 - s.s22) / 2;
  const Real radius = sqrt(half * half + s.s12 * s.s12);
  const Real low = mean - radius, high = mean + radius;
  if (low >= 0) return s;
  if (high <= 0) return {0, 0, 0};
  const Real scale = high / (2 * radius);  // high * d d^T, d the direction of the larger principal stress
  return {scale * (radius + half), scale * (radius - half), scale * s.s12};
}

// Returns the factor of the identity that a stress adds to block (i, j) of the stiffness [N/m].
template <class Real>
HYST_HD inline Real geometric_stiffness(const MembraneRest<Real>& rest, const MembraneStress<Real>& s, int i,
                                        int j) {
  const Real i1 = rest.b1[i], i2 = rest.b2[i], j1 = rest.b1[j], j2 = rest.b2[j];
  return rest.area * (s.s11 * i1 * j1 + s.s22 * i2 * j2 + s.s12 * (i1 * j2 + i2 * j1));
}

// The coefficients of block (i, j) of the Gauss-Newton stiffness, which is the sum over a, b of f_a k_ab
// f_b^T.
template <class Real>
struct MembraneCoefficients {
  Real k11, k12, k21, k22;  // [N/m]
};

template <class Real>
HYST_HD inline MembraneCoefficients<Real> membrane_coefficients(const MembraneRest<Real>& rest,
                                                                const MembraneStiffness<Real>& c, Real factor,
                                                                int i, int j) {
  const Real i1 = rest.b1[i], i2 = rest.b2[i], j1 = rest.b1[j], j2 = rest.b2[j];
  const Real a = factor * rest.area;
  return {a * (c.warp * i1 * j1 + c.shear * i2 * j2), a * (c.coupling * i1 * j2 + c.shear * i2 * j1),
          a * (c.coupling * i2 * j1 + c.shear * i1 * j2), a * (c.weft * i2 * j2 + c.shear * i1 * j1)};
}

// Returns block (i, j) of the stiffness -df_i/dx_j: `factor` times the Gauss-Newton part plus the geometric
// part of `tension`.
template <class Real>
HYST_HD inline Mat3<Real> membrane_block(const MembraneRest<Real>& rest, const MembraneStiffness<Real>& c,
                                         Real factor, const Deformation<Real>& f,
                                         const MembraneStress<Real>& tension, int i, int j) {
  const MembraneCoefficients<Real> k = membrane_coefficients(rest, c, factor, i, j);
  const Real geometric = geometric_stiffness(rest, tension, i, j);
  const Vec3<Real> r1 = k.k11 * f.f1 + k.k12 * f.f2, r2 = k.k21 * f.f1 + k.k22 * f.f2;
  Mat3<Real> block;
  for (int col = 0; col < 3; ++col)
    for (int row = 0; row < 3; ++row) block(row, col) = f.f1[row] * r1[col] + f.f2[row] * r2[col];
  for (int d = 0; d < 3; ++d) block(d, d) += geometric;
  return block;
}

// Returns one of its columns, with the same bits.
template <class Real>
HYST_HD inline Vec3<Real> membrane_column(const MembraneRest<Real>& rest, const MembraneStiffness<Real>& c,
                                          Real factor, const Deformation<Real>& f,
                                          const MembraneStress<Real>& tension, int i, int j, int col) {
  const MembraneCoefficients<Real> k = membrane_coefficients(rest, c, factor, i, j);
  const Real r1 = k.k11 * f.f1[col] + k.k12 * f.f2[col], r2 = k.k21 * f.f1[col] + k.k22 * f.f2[col];
  const Real geometric = geometric_stiffness(rest, tension, i, j);
  Vec3<Real> column;
  for (int row = 0; row < 3; ++row) {
    const Real entry = f.f1[row] * r1 + f.f2[row] * r2;
    column[row] = row == col ? entry + geometric : entry;
  }
  return column;
}

}  // namespace hysteron
