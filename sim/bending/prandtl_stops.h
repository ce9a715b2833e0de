// Bending hysteresis as N elastic-frictional stops beside an elastic plate: Prandtl-Ishlinskii.
//
//   U_j = S - S_j,   E_j = U_j min(1, r_j/|U_j|),   M = b2 S + sum_j p E_j,   accepted: S_j = S - E_j
//   r_j = (j - 1/2) K0/N,   p = (b1 - b2)/N,   j = 1..N
//
// The virgin curve of the chapter (Wong, Eq. 4.2) is that of stops spread evenly over [0, K0], because the
// threshold density of a virgin curve f is -f'' (Whiteman 1959, Iwan 1966).  A branch after a reversal is then
// the doubled virgin curve, slope b1 and quadratic coefficient -+M0/(2 K0^2) over 2 K0: the chapter's Eqs. 4.4
// and 4.5.  N stops miss the virgin curve by at most M0/(4 N^2).  Chosen here, not in the chapter: the memory
// itself (it breaks off before partial reversals), the even spread of finitely many thresholds, and the radial
// return |E_j| <= r_j on the tensor, which makes a cylinder in any direction follow the scalar law.
// Dissipated in a step: sum p r_j (|U_j| - r_j)+, never negative.  K0 = 0 or b1 = b2 leave M = b2 K.
#pragma once

#include <cmath>

#include "sim/bending/law.h"
#include "sim/bending/zero_moment.h"

namespace hysteron {

template <class Real, int D, int N>
struct PrandtlStops {
  static constexpr int kDimension = D;
  static constexpr int kHistory = N * D;  // slip S_j [1/m], laid out [component][stop] so that stops vectorise
  using Scalar = Real;

  Real b2 = 0;  // rigidity of the straight branch [N m]
  Real p = 0;   // rigidity of one stop [N m]
  Real limit[N] = {};  // r_j: curvature at which stop j slips [1/m]

  static PrandtlStops make(const VirginCurve& curve) {
    PrandtlStops law;
    law.b2 = Real(curve.b2);
    law.p = curve.k0 > 0 ? Real((curve.b1 - curve.b2) / N) : Real(0);
    constexpr double kSomeLimit = 1;  // any positive number: without stiffness the stops carry nothing
    for (int j = 0; j < N; ++j) law.limit[j] = Real((j + 0.5) * (curve.k0 > 0 ? curve.k0 : kSomeLimit) / N);
    return law;
  }

  HYST_HD LawStep<Real, D, kHistory> step(const Vec<Real, D>& curvature,
                                          const History<Real, kHistory>& before) const {
    LawStep<Real, D, kHistory> result;
    Real elastic[D][N], reach[N], scale[N];
    stretch(curvature, before, elastic, reach, scale);
    Real energy[N], loss[N];
    for (int j = 0; j < N; ++j) energy[j] = scale[j] * reach[j] * scale[j] * reach[j];  // |E_j|^2
    for (int j = 0; j < N; ++j) loss[j] = limit[j] * (1 - scale[j]) * reach[j];         // r_j (|U_j| - r_j)+
    for (int c = 0; c < D; ++c) {
      const Real k = curvature[c];
      for (int j = 0; j < N; ++j) elastic[c][j] *= scale[j];
      for (int j = 0; j < N; ++j) result.history[c * N + j] = k - elastic[c][j];
      result.moment[c] = b2 * k + p * sum(elastic[c]);
    }
    result.stored = (b2 * curvature.squaredNorm() + p * sum(energy)) / 2;
    result.dissipated = p * sum(loss);
    return result;
  }

  HYST_HD Tangent<Real, D> tangent(const Vec<Real, D>& curvature, const History<Real, kHistory>& before) const {
    Real elastic[D][N], reach[N], scale[N], slipping[N];
    stretch(curvature, before, elastic, reach, scale);
    for (int j = 0; j < N; ++j) slipping[j] = scale[j] < 1 ? scale[j] / (reach[j] * reach[j]) : Real(0);
    Tangent<Real, D> result = (b2 + p * sum(scale)) * Tangent<Real, D>::Identity();
    for (int a = 0; a < D; ++a) {
      for (int b = 0; b <= a; ++b) {
        Real product[N];
        for (int j = 0; j < N; ++j) product[j] = slipping[j] * elastic[a][j] * elastic[b][j];
        const Real total = p * sum(product);
        result(a, b) -= total;
        if (a != b) result(b, a) -= total;
      }
    }
    return result;
  }

  HYST_HD Vec<Real, D> residual(const History<Real, kHistory>& history) const {
    Vec<Real, D> mean_slip;
    for (int c = 0; c < D; ++c) {
      Real slip[N];
      for (int j = 0; j < N; ++j) slip[j] = history[c * N + j];
      mean_slip[c] = sum(slip) / N;
    }
    return zero_moment(*this, history, mean_slip);
  }
  HYST_HD Real largest_stiffness() const { return b2 + N * p; }

 private:
  // offset[c][j] = U_j, reach[j] = max(|U_j|, r_j), scale[j] = min(1, r_j/|U_j|).
  HYST_HD void stretch(const Vec<Real, D>& curvature, const History<Real, kHistory>& before,
                       Real (&offset)[D][N], Real (&reach)[N], Real (&scale)[N]) const {
    using std::sqrt;
    Real squared[N] = {};
    for (int c = 0; c < D; ++c) {
      const Real k = curvature[c];
      for (int j = 0; j < N; ++j) offset[c][j] = k - before[c * N + j];
      for (int j = 0; j < N; ++j) squared[j] += offset[c][j] * offset[c][j];
    }
    for (int j = 0; j < N; ++j) {
      const Real length = sqrt(squared[j]);
      reach[j] = length;
      scale[j] = limit[j] / (length > limit[j] ? length : limit[j]);
    }
  }

  // Pairwise, so that the order is fixed and the compiler may still add several stops at once.
  HYST_HD static Real sum(const Real (&term)[N]) {
    Real part[N];
    for (int j = 0; j < N; ++j) part[j] = term[j];
    for (int n = N; n > 1; n = (n + 1) / 2) {
      const int kept = (n + 1) / 2;
      for (int j = 0; j < n - kept; ++j) part[j] += part[j + kept];
    }
    return part[0];
  }
};

}  // namespace hysteron
