// Compares loops of a FAB tester with simulated ones in metrics, tables and plots, for `fab` and `fit --fab`.
#pragma once

#include <string>
#include <vector>

#include "experiments/workbench/app/run.h"
#include "sim/reference/fab_test.h"

namespace hysteron::experiments {

// Measured loops (forces are NaN where not measured) and a run along their path.
struct ComparedLoops {
  FabLoops loops;
  FabRun run;
  bool measured = true;
  double zero = 0;  // offset of the measured force, found by this run [N/m]

  ComparedLoops(FabLoops loops, FabRun run, bool measured);
  BranchForces measured_forces() const;  // relative to that offset [N/m]
};

// Parses `si` or `fab`; throws Error::invalid_input for others.
TesterUnits tester_units(const std::string& name);

// Adds area, peak force and force range of each cycle, also as measured_...; rms, zero and energy balance.
void add_metrics(Run& run, const ComparedLoops& compared);
// Writes the columns that `fit --fab` reads, with the measured force last.
void write_loops(Run& run, const std::string& name, const ComparedLoops& compared);
void draw_loops(Run& run, const std::string& name, const std::string& title, const ComparedLoops& compared);
// Draws the strip at the reversals of the clamps, unless it stretches.
void draw_shapes(Run& run, const std::string& name, const std::string& title, const ComparedLoops& compared);

}  // namespace hysteron::experiments
