// Friction elements of bending from the loops of a FAB tester: the test is simulated with trial elements, and
// the forces compared.
//
// Thresholds are a fixed grid, so that a coarse record decides about stiffnesses alone.  Their logarithms
// have a prior, without which elements that a cycle hardly slips would go to nothing or grow without bound
// (ridge of Hoerl & Kennard 1970 in logarithms; Tarantola 2005, section 3.2): a friction moment by the work
// of the loop over the change of the bend, shared alike; b2 by HB/b2 of textiles.
#pragma once

#include <string>
#include <vector>

#include "sim/identification/identification.h"
#include "sim/reference/fab_test.h"

namespace hysteron {

struct FabBendingQuestion {
  std::vector<int> cycles = {2};                                  // that are fitted, the first being 1
  std::vector<double> thresholds = {4, 8, 16, 32, 64, 128, 256};  // [1/m], rising
  double density = 0;                                             // [kg/m^2]
  double noise = 7.5e-4;   // of the force of the whole strip [N]: FAB records scatter by 0.05 to 0.1 gf
  double settling = 5e-4;  // way after a reversal on which records are unreliable [m] ...
  double trust = 0.3;      // ... and their weight there
};

struct FabBending {
  std::string direction;
  StopsLaw law;
  // Standard errors: of stiffnesses, whose logarithms are sought, that of the logarithm times the value [N
  // m].
  double spring_error = kNone;
  std::vector<double> stiffness_errors;
  std::vector<bool> determined;                 // of the spring, then of each stop
  double friction_error = kNone;                // of law.friction() [N]
  std::vector<double> zero, zero_errors;        // of force, by fitted loops [N/m]
  double residual_rms = 0;                      // over the noise, unreliable rows weighted
  double prior_friction = 0, prior_spring = 0;  // that the prior is centred on [N], [N m]
  int rows = 0, iterations = 0;
  bool converged = false;

  std::vector<std::string> undetermined() const;  // "b2", "stop 128/m", ...
};

// From loops of one direction that bend.  Throws Error::request if a cycle is not there.
FabBending identify_fab_bending(const std::vector<FabLoops>& loops, const FabBendingQuestion& question);

// The one element of the grid that describes the same loops best: a constant 2HB.
FabBending identify_one_stop(const std::vector<FabLoops>& loops, const FabBendingQuestion& question);

}  // namespace hysteron
