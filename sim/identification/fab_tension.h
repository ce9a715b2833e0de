// Identifies tension stiffness and friction elements of stretch from the loops of a FAB tester, as
// fab_bending.h does for bending: with a fixed grid of thresholds (strain) and a prior on logarithms.
#pragma once

#include <string>
#include <vector>

#include "sim/identification/fab_cycles.h"

namespace hysteron {

struct FabTensionQuestion {
  std::vector<int> cycles = {2};                                        // fitted cycles, the first being 1
  std::vector<double> thresholds = {0.002, 0.005, 0.0125, 0.03, 0.08};  // strains, rising
  // Noise of the force of the whole strip [N], beside `fraction` of the largest force, which no such law
  // describes better.
  double noise = 2e-3;
  double fraction = 0.01;  // share of the largest force
};

struct FabTension : FabStops {  // [N/m] against strain
  double residual_rms = 0;      // [N/m]
  double largest_force = 0;     // of the fitted rows, over the zero [N/m]

  std::vector<std::string> undetermined() const;  // names "warp spring", "stop 0.08"
};

// Identifies from loops of one direction that stretch.  Throws Error::invalid_input if a cycle is missing.
FabTension identify_fab_tension(const std::vector<FabLoops>& loops, const FabTensionQuestion& question);

}  // namespace hysteron
