// Models bending hysteresis by N elastic-frictional stops beside an elastic plate (Prandtl-Ishlinskii).
//
//   U_j = S - S_j,   E_j = U_j min(1, r_j/|U_j|),   M = b2 S + sum_j p_j E_j,   accepted: S_j = S - E_j
//   r_j = K0 (j^2 - j + 1/2)/N^2,   p_j = (b1 - b2) (2 j - 1)/N^2,   j = 1..N
//
// The virgin curve of the chapter (Wong, Eq. 4.2) is that of stops spread evenly over [0, K0], because the
// threshold density of a virgin curve f is -f'' (Whiteman 1959, Iwan 1966).  A branch after a reversal is
// then the doubled virgin curve, slope b1 and quadratic coefficient -+M0/(2 K0^2) over 2 K0: the chapter's
// Eqs. 4.4 and 4.5.  Each of the N stops stands in the middle of the stretch from K0 (j - 1)^2/N^2 to
// K0 j^2/N^2 and has the stiffness of all that slip there: the virgin curve is exact at the ends of these
// stretches and missed by at most M0/N^2 between them.  They are short where curvatures are small, because
// below the lowest threshold nothing is lost and a swing would ring on (docs/laws.md).  Chosen here, not in
// the chapter: the memory itself (it breaks off before partial reversals), the spacing of finitely many
// thresholds, and the radial return |E_j| <= r_j on the tensor, which makes a cylinder in any direction
// follow the scalar law.  Dissipated in a step: sum p_j r_j (|U_j| - r_j)+, never negative.  K0 = 0 or
// b1 = b2 leave M = b2 K.
#pragma once

#include "sim/bending/laws/bending_parts.h"
#include "sim/bending/laws/stop_memory.h"
#include "sim/bending/laws/zero_moment.h"

namespace hysteron {

template <class Real, int D, int N>
struct PrandtlStops : StopMemory<Real, D, N> {
  using Memory = StopMemory<Real, D, N>;
  using Memory::kHistory;
  using Memory::limit;

  Real b2 = 0;     // rigidity of the straight branch [N m]
  Real p[N] = {};  // p_j: rigidity of each stop [N m]

  static PrandtlStops make(const VirginCurve& curve) {
    PrandtlStops law;
    law.b2 = Real(curve.b2);
    constexpr double kSomeLimit = 1;  // any positive number: without stiffness the stops carry nothing
    const bool friction = curve.k0 > 0;
    for (int j = 0; j < N; ++j) {
      const ParabolaStop stop = parabola_stop(j, N);
      law.limit[j] = Real(stop.threshold * (friction ? curve.k0 : kSomeLimit));
      law.p[j] = friction ? Real(stop.stiffness * (curve.b1 - curve.b2)) : Real(0);
    }
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
      result.moment[c] = b2 * curvature[c] + sum(PerStop(stiffnesses() * elastic));
    }
    result.stored = (b2 * curvature.squaredNorm() + sum(PerStop(stiffnesses() * held * held))) / 2;
    result.dissipated = sum(PerStop(stiffnesses() * limits() * (now.length - held)));
    return result;
  }

  HYST_HD Tangent<Real, D> tangent(const Vec<Real, D>& curvature,
                                   const History<Real, kHistory>& before) const {
    const Stretch now = stretch(curvature, before);
    const PerStop slipping = stiffnesses() * turning(now);
    Tangent<Real, D> result = (b2 + sum(PerStop(stiffnesses() * now.scale))) * Tangent<Real, D>::Identity();
    for (int a = 0; a < D; ++a)
      for (int b = 0; b < D; ++b) result(a, b) -= sum(PerStop(slipping * now.offset[a] * now.offset[b]));
    return result;
  }

  HYST_HD Vec<Real, D> residual(const History<Real, kHistory>& history) const {
    const Real all = stops_stiffness();
    Vec<Real, D> mean_slip = Vec<Real, D>::Zero();
    for (int c = 0; c < D && all > Real(0); ++c)
      mean_slip[c] = sum(PerStop(stiffnesses() * slip(history, c))) / all;
    return zero_moment(*this, history, mean_slip);
  }
  HYST_HD Real largest_stiffness() const { return b2 + stops_stiffness(); }

 private:
  using Memory::limits;
  using Memory::slip;
  using Memory::stretch;
  using Memory::sum;
  using Memory::turning;
  using typename Memory::PerStop;
  using typename Memory::Stretch;

  HYST_HD Eigen::Map<const PerStop> stiffnesses() const { return Eigen::Map<const PerStop>(p); }
  HYST_HD Real stops_stiffness() const { return sum(PerStop(stiffnesses())); }
};

}  // namespace hysteron
