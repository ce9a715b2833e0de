// Bending hysteresis as N elastic-frictional stops beside an elastic plate: Prandtl-Ishlinskii.
//
//   U_j = S - S_j,   E_j = U_j min(1, r_j/|U_j|),   M = b2 S + sum_j p E_j,   accepted: S_j = S - E_j
//   r_j = (j - 1/2) K0/N,   p = (b1 - b2)/N,   j = 1..N
//
// The virgin curve of the chapter (Wong, Eq. 4.2) is that of stops spread evenly over [0, K0], because the
// threshold density of a virgin curve f is -f'' (Whiteman 1959, Iwan 1966).  A branch after a reversal is
// then the doubled virgin curve, slope b1 and quadratic coefficient -+M0/(2 K0^2) over 2 K0: the chapter's
// Eqs. 4.4 and 4.5.  N stops miss the virgin curve by at most M0/(4 N^2).  Chosen here, not in the chapter:
// the memory itself (it breaks off before partial reversals), the even spread of finitely many thresholds,
// and the radial return |E_j| <= r_j on the tensor, which makes a cylinder in any direction follow the scalar
// law. Dissipated in a step: sum p r_j (|U_j| - r_j)+, never negative.  K0 = 0 or b1 = b2 leave M = b2 K.
#pragma once

#include "sim/bending/laws/stop_memory.h"
#include "sim/bending/laws/zero_moment.h"

namespace hysteron {

template <class Real, int D, int N>
struct PrandtlStops : StopMemory<Real, D, N> {
  using Memory = StopMemory<Real, D, N>;
  using Memory::kHistory;
  using Memory::limit;

  Real b2 = 0;  // rigidity of the straight branch [N m]
  Real p = 0;   // rigidity of one stop [N m]

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
    const Stretch now = stretch(curvature, before);
    const PerStop held = now.scale * now.length;
    for (int c = 0; c < D; ++c) {
      const PerStop elastic = now.offset[c] * now.scale;
      slip(result.history, c) = curvature[c] - elastic;
      result.moment[c] = b2 * curvature[c] + p * sum(elastic);
    }
    result.stored = (b2 * curvature.squaredNorm() + p * sum(PerStop(held * held))) / 2;
    result.dissipated = p * sum(PerStop(limits() * (now.length - held)));
    return result;
  }

  HYST_HD Tangent<Real, D> tangent(const Vec<Real, D>& curvature,
                                   const History<Real, kHistory>& before) const {
    const Stretch now = stretch(curvature, before);
    const PerStop slipping = turning(now);
    Tangent<Real, D> result = (b2 + p * sum(now.scale)) * Tangent<Real, D>::Identity();
    for (int a = 0; a < D; ++a)
      for (int b = 0; b < D; ++b) result(a, b) -= p * sum(PerStop(slipping * now.offset[a] * now.offset[b]));
    return result;
  }

  HYST_HD Vec<Real, D> residual(const History<Real, kHistory>& history) const {
    Vec<Real, D> mean_slip;
    for (int c = 0; c < D; ++c) mean_slip[c] = sum(PerStop(slip(history, c))) / N;
    return zero_moment(*this, history, mean_slip);
  }
  HYST_HD Real largest_stiffness() const { return b2 + N * p; }

 private:
  using Memory::limits;
  using Memory::slip;
  using Memory::stretch;
  using Memory::sum;
  using Memory::turning;
  using typename Memory::PerStop;
  using typename Memory::Stretch;
};

}  // namespace hysteron
