// Where the time of a step goes, kernel by kernel: the profile of a scene's steps.
#pragma once

#include <string>
#include <vector>

#include "experiments/workbench/app/manifest.h"
#include "sim/time/simulation.h"

namespace hysteron::experiments {

// Of the steps that were profiled.
struct StepProfile {
  Metrics step;                  // what a step takes and asks of its device
  std::vector<Metrics> kernels;  // one row per kernel, the slowest first
};

// Advances by so many steps; the time of one [ms].
double ms_per_step(Simulation& simulation, int steps);

// Advances by `steps` to warm up, by as many unprofiled for the time of a step, and by as many profiled.
//
// A kernel's bytes are what its loop must move at least, each array that it reads or writes once; kernels
// whose loops do not state them have none.  What one kernel leaves in the cache for the next counts as moved:
// small cloths may exceed the bandwidth of a copy, which does not fit.
StepProfile profile_of_steps(Simulation& simulation, int steps);

}  // namespace hysteron::experiments
