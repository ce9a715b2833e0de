// Measures time, launches and memory traffic of a step, in total and kernel by kernel.
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
  // Returns the time since construction [s].
  double seconds() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point start_ = Clock::now();
};

// The cost of one step, as a mean over all timed steps; NaN where unknown.
struct StepCost {
  double ms = NAN, ms_fastest = NAN, ms_slowest = NAN;  // median, least and most of the batches [ms]
  double launches = NAN, synchronizations = NAN, allocations = NAN;
  double newton_iterations = NAN, solver_iterations = NAN;
};

// Advances `batches` times by `steps` steps, each batch timed by itself.  If each step consists of several
// `parts`, such as substeps, the cost is that of one part.
StepCost cost_of_steps(Simulation& simulation, int batches, int steps, int parts = 1);
// Sets all of the cost in a row: "ms_per_step", "launches_per_step", ...
void set(Metrics& row, const StepCost& cost);

// Returns the rows as a table with the keys of the first.
Table metrics_table(const std::vector<Metrics>& rows);

// Returns the cost of each loop by name, over `steps` steps.  From then on the simulation is profiled, and
// slower for it.
KernelCosts loops_of_steps(Simulation& simulation, int steps);
// Returns the bytes that the kernels must move at least: each array that a loop reads or writes, once.
// Kernels whose loops do not state them count as nothing.
double stated_bytes(const KernelCosts& costs);

// The profile of the measured steps.
struct StepProfile {
  Metrics step;                  // cost of one step
  std::vector<Metrics> kernels;  // one row per kernel, the slowest first
};

// Advances by `steps` to warm up, by as many unprofiled for the time of a step, and by as many profiled.
//
// Bytes that one kernel leaves in the cache for the next count as moved, so small cloths may exceed the
// bandwidth of a copy that does not fit into the cache.
StepProfile profile_of_steps(Simulation& simulation, int steps);

}  // namespace hysteron::experiments
