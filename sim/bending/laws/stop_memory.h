// What laws made of N friction elements ("stops") have in common: thresholds, memory, stretches.
//
//   U_j = S - S_j,   E_j = U_j min(1, r_j/|U_j|),   accepted: S_j = S - E_j
//
// The radial return |E_j| <= r_j on the tensor makes a cylinder in any direction follow the scalar law.
#pragma once

#include <cmath>

#include "sim/bending/laws/law.h"

namespace hysteron {

// How nvcc writes loops over stops: `unrolled` in registers, or as loops over a GPU's local memory, where a
// law is written many times over or has more stops than there are registers; unrolled those take minutes to
// compile.
enum class StopLoops { unrolled, rolled };
constexpr StopLoops loops_over(int stops) { return stops <= 8 ? StopLoops::unrolled : StopLoops::rolled; }

template <class Real, int D, int N, StopLoops loops = loops_over(N)>
struct StopMemory {
  static constexpr int kDimension = D;
  static constexpr int kHistory =
      N * D;  // slip S_j [1/m], laid out [component][stop] so that stops vectorise
  using Scalar = Real;

  struct Stretch {
    Real offset[D][N];  // U_j by component [1/m]
    Real length[N];     // |U_j| [1/m]
    Real scale[N];      // min(1, r_j/|U_j|)
  };

  Real limit[N] = {};  // r_j: curvature at which stop j slips [1/m]

 protected:
  static constexpr int kUnrolled = loops == StopLoops::unrolled ? N : 1;
  static_assert((N & (N - 1)) == 0, "the number of stops is a power of two");

  template <class Body>
  HYST_HD static void for_each_stop(const Body& body) {
    HYST_UNROLL(kUnrolled)
    for (int j = 0; j < N; ++j) body(j);
  }

  // Of term(j), by halves, so that the order does not depend on the width of a vector register.
  template <class Term>
  HYST_HD static Real sum_over_stops(const Term& term) {
    Real sum[N];
    for_each_stop([&](int j) { sum[j] = term(j); });
    for (int half = N / 2; half > 0; half /= 2) {
      HYST_UNROLL(kUnrolled)
      for (int j = 0; j < half; ++j) sum[j] += sum[j + half];
    }
    return sum[0];
  }

  HYST_HD Stretch stretch(const Vec<Real, D>& curvature, const History<Real, kHistory>& before) const {
    using std::abs, std::sqrt;
    Stretch now;
    for_each_stop([&](int j) {
      for (int c = 0; c < D; ++c) now.offset[c][j] = curvature[c] - before.slot[c * N + j];
      Real length = abs(now.offset[0][j]);
      if constexpr (D > 1) {
        Real squared = now.offset[0][j] * now.offset[0][j];
        for (int c = 1; c < D; ++c) squared += now.offset[c][j] * now.offset[c][j];
        length = sqrt(squared);
      }
      now.length[j] = length;
      now.scale[j] = limit[j] / (length > limit[j] ? length : limit[j]);
    });
    return now;
  }

  // The slips S_j after the step.
  HYST_HD static void store_slips(const Stretch& now, const Vec<Real, D>& curvature,
                                  History<Real, kHistory>& after) {
    for (int c = 0; c < D; ++c)
      for_each_stop([&](int j) { after.slot[c * N + j] = curvature[c] - now.offset[c][j] * now.scale[j]; });
  }
  // Length of the stretch that stop j holds [1/m].
  HYST_HD static Real held(const Stretch& now, int j) { return now.scale[j] * now.length[j]; }

  // Of a slipping stop, what turns stretches into d(scale)/d(stretch); 0 of another [m^2].
  HYST_HD static Real turning(const Stretch& now, int j) {
    const Real squared = now.length[j] * now.length[j];
    return now.scale[j] < Real(1) ? now.scale[j] / squared : Real(0);
  }

  HYST_HD static Vec<Real, D> mean_slip(const History<Real, kHistory>& history) {
    Vec<Real, D> mean;
    for (int c = 0; c < D; ++c) mean[c] = sum_over_stops([&](int j) { return history.slot[c * N + j]; }) / N;
    return mean;
  }
};

}  // namespace hysteron
