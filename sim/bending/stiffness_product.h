// Applies bending's stiffness J^T C^T T C J (BendingFactors) to displacements, loop by loop.
#pragma once

#include "sim/bending/law_loop.h"

namespace hysteron {

// N numbers of an array, aligned to 16 bytes, which a GPU moves at once.
template <class Real, int N>
struct alignas(16) Aligned {
  Real value[N];
  HYST_HD static const Aligned& of(const Real* array, int i) {
    return reinterpret_cast<const Aligned*>(array)[i];
  }
  HYST_HD static Aligned& of(Real* array, int i) { return reinterpret_cast<Aligned*>(array)[i]; }
};

// Computes the rate of each hinge's angle along v: J v.
template <class Real>
struct HingeRates {
  const Eigen::Vector4i* corner;
  const Real* gradient;
  const Vec3<Real>* v;
  Real* rate;

  HYST_HD void operator()(int h) const {
    const Eigen::Vector4i c = corner[h];
    const Aligned<Real, 8> hinge = Aligned<Real, 8>::of(gradient, h);
    const Real* g = hinge.value;
    const Vec3<Real> along = v[c[3]] - v[c[2]];
    rate[h] = Vec3<Real>(g[0], g[1], g[2]).dot(v[c[0]] - v[c[2]] - g[6] * along) +
              Vec3<Real>(g[3], g[4], g[5]).dot(v[c[1]] - v[c[2]] - g[7] * along);
  }
};

// Computes A M of each element: T C rate.
template <class Real, int D>
struct ElementMoments {
  OperatorView<Real> op;
  const Real *rate, *tangent;
  Real* moment_area;

  HYST_HD void operator()(int i) const {
    const Vec<Real, D> k = op.template curvature<D>(i, rate);
    if constexpr (D == 1) {
      moment_area[i] = tangent[i] * k[0];
    } else {
      const Real* t = tangent + 6 * i;
      moment_area[3 * i] = t[0] * k[0] + t[1] * k[1] + t[3] * k[2];
      moment_area[3 * i + 1] = t[1] * k[0] + t[2] * k[1] + t[4] * k[2];
      moment_area[3 * i + 2] = t[3] * k[0] + t[4] * k[1] + t[5] * k[2];
    }
  }
};

// Computes the torque of each hinge, and the forces along its gradients: -J^T C^T A M.
template <class Real, int D>
struct HingeForces {
  const int *start, *element;  // columns of C: hinges
  const Real *coefficient, *moment_area, *gradient;
  Vec3<Real>* force;

  HYST_HD void operator()(int h) const {
    Real torque = 0;
    for (int j = start[h]; j < start[h + 1]; ++j)
      for (int k = 0; k < D; ++k) torque += coefficient[j * D + k] * moment_area[element[j] * D + k];
    const Aligned<Real, 8> hinge = Aligned<Real, 8>::of(gradient, h);
    const Real* g = hinge.value;
    const Vec3<Real> f0 = -torque * Vec3<Real>(g[0], g[1], g[2]);
    const Vec3<Real> f1 = -torque * Vec3<Real>(g[3], g[4], g[5]);
    const Vec3<Real> f3 = -(g[6] * f0 + g[7] * f1), f2 = -(f0 + f1 + f3);
    Aligned<Real, 12>::of(force->data(), h) = {
        {f0[0], f0[1], f0[2], f1[0], f1[1], f1[2], f2[0], f2[1], f2[2], f3[0], f3[1], f3[2]}};
  }
};

}  // namespace hysteron
