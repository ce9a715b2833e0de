// What a step takes and asks of its device, and where its time goes, kernel by kernel.
#pragma once

#include <chrono>
#include <cmath>
#include <string>
#include <vector>

#include "experiments/workbench/app/manifest.h"
#include "sim/base/csv.h"
#include "sim/time/simulation.h"

namespace hysteron::experiments {

class Stopwatch {
 public:
  // Since it was made [s].
  double seconds() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point start_ = Clock::now();
};

// Of one step, as a mean over all that were timed; not known by default.
struct StepCost {
  double ms = NAN, ms_fastest = NAN, ms_slowest = NAN;  // the median, least and most of the batches
  double launches = NAN, synchronizations = NAN, allocations = NAN;
  double newton_iterations = NAN, solver_iterations = NAN;
};

// Advances by `batches` times `steps`, each batch timed by itself.  `parts`: of how many each step consists
// whose cost is asked for, as of substeps.
StepCost cost_of_steps(Simulation& simulation, int batches, int steps, int parts = 1);
// Sets all of it in a row: "ms_per_step", "launches_per_step", ...
void set(Metrics& row, const StepCost& cost);

// Rows of the keys that the first has.
Table metrics_table(const std::vector<Metrics>& rows);

// Loops by their names, of so many steps.  From then on the simulation is profiled, and slower for it.
KernelCosts loops_of_steps(Simulation& simulation, int steps);
// What they must move at least: a kernel's bytes are each array that its loop reads or writes, once.  Kernels
// whose loops do not state them count as nothing.
double stated_bytes(const KernelCosts& costs);

// Of the steps that were profiled.
struct StepProfile {
  Metrics step;                  // what a step takes and asks of its device
  std::vector<Metrics> kernels;  // one row per kernel, the slowest first
};

// Advances by `steps` to warm up, by as many unprofiled for the time of a step, and by as many profiled.
//
// What one kernel leaves in the cache for the next counts as moved: small cloths may exceed the bandwidth of
// a copy, which does not fit.
StepProfile profile_of_steps(Simulation& simulation, int steps);

}  // namespace hysteron::experiments
