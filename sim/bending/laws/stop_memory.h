// The common base of laws made of N friction elements ("stops"): thresholds, memory, stretches.
//
//   U_j = S - S_j,   E_j = U_j min(1, r_j/|U_j|),   accepted: S_j = S - E_j
//
// The radial return |E_j| <= r_j on the tensor makes a cylinder in any direction follow the scalar law.
#pragma once

#include "sim/bending/laws/law.h"

namespace hysteron {

template <class Real, int D, int N>
struct StopMemory {
  static constexpr int kDimension = D;
  static constexpr int kHistory = N * D;  // slips S_j [1/m] by [component][stop], so that stops vectorise
  using Scalar = Real;
  using PerStop = Eigen::Array<Real, N, 1>;  // compiles to vector registers on the CPU

  struct Stretch {
    PerStop offset[D];  // U_j by component [1/m]
    PerStop length;     // |U_j| [1/m]
    PerStop scale;      // min(1, r_j/|U_j|)
  };

  Real limit[N] = {};  // r_j: curvature at which stop j slips [1/m]

 protected:
  HYST_HD Eigen::Map<const PerStop> limits() const { return Eigen::Map<const PerStop>(limit); }
  HYST_HD static Eigen::Map<PerStop> slip(History<Real, kHistory>& h, int component) {
    return Eigen::Map<PerStop>(h.slot + component * N);
  }
  HYST_HD static Eigen::Map<const PerStop> slip(const History<Real, kHistory>& h, int component) {
    return Eigen::Map<const PerStop>(h.slot + component * N);
  }

  HYST_HD Stretch stretch(const Vec<Real, D>& curvature, const History<Real, kHistory>& before) const {
    Stretch now;
    for (int c = 0; c < D; ++c) now.offset[c] = curvature[c] - slip(before, c);
    now.length = now.offset[0].abs();
    if constexpr (D > 1) {
      PerStop squared = now.offset[0] * now.offset[0];
      for (int c = 1; c < D; ++c) squared += now.offset[c] * now.offset[c];
      now.length = squared.sqrt();
    }
    now.scale = limits() / now.length.max(limits());
    return now;
  }

  // Returns for slipping stops the factor from stretches to d(scale)/d(stretch), and 0 for the others [m^2].
  HYST_HD static PerStop turning(const Stretch& now) {
    const PerStop squared = now.length * now.length;
    return (now.scale < Real(1)).select(now.scale / squared, PerStop::Zero());
  }

  // Sums by halves, so that the order does not depend on the width of a vector register.
  template <int n>
  HYST_HD static Real sum(const Eigen::Array<Real, n, 1>& term) {
    if constexpr (n == 1) {
      return term[0];
    } else {
      static_assert(n % 2 == 0, "the number of stops is a power of two");
      return sum<n / 2>(
          Eigen::Array<Real, n / 2, 1>(term.template head<n / 2>() + term.template tail<n / 2>()));
    }
  }
};

}  // namespace hysteron
