// Parallel friction elements with free thresholds, identified from bending loops (Ngo Ngoc & Boivin 2004,
// "Nonlinear Cloth Simulation", INRIA RR-5099): a spring b2 beside stops, springs p_j that slip at r_j,
//
//   M = b2 K + sum_j p_j clamp(K - S_j, -r_j, r_j),   S_j dragged along
//
// which is the `prandtl` law with `memory=stops` (uniform r_j, equal p_j) left free.
#pragma once

#include "sim/identification/identification.h"
#include "sim/identification/series.h"

namespace hysteron {

struct Stop {
  double threshold = 0;                                     // r_j [1/m]
  double stiffness = 0;                                     // p_j [N m]
  double threshold_error = kNone, stiffness_error = kNone;  // standard errors; kNone: undetermined
};

struct StopsIdentification {
  Identification fabric;  // model, residuals and iterations of the elements; b1, b2, k0 of the quadratic law
  double spring = 0;      // b2 of the elements [N m]
  std::vector<Stop> stops;  // by rising threshold
  bool converged = false;
};

inline constexpr int kMaxFittedStops = 16;

// Moments of the elements along accepted steps [N].
std::vector<double> stops_moments(double b2, const std::vector<Stop>& stops, const std::vector<LawRow>& rows);

// From `count` equal stops, spread evenly over half the largest curvature; the iterations it takes from there
// are counted.  The fabric's numbers are those of `prandtl` from the same data: a few elements have no k0.
StopsIdentification identify_stops(const MomentSeries& series, int count, const Assumptions& assumptions);

}  // namespace hysteron
