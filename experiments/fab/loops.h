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

// Adds area, peak force and force range of each cycle, also as measured_...; rms, zero and energy balance.
void add_metrics(Run& run, const ComparedLoops& compared);
// Writes the columns that `fit --fab` reads, with the measured force last.
void write_loops(Run& run, const std::string& name, const ComparedLoops& compared);
void draw_loops(Run& run, const std::string& name, const std::string& title, const ComparedLoops& compared);
// A panel a cycle, named "cycle 2, fitted" by `kinds`: the simulated force as a line; what was measured as
// bars between the record and its `repeat`, the same way with the strip turned over, or as dots where there
// is none (null).  Each panel's title says by how much the area is off and the rms of the difference over
// `noise` [N/m].
void draw_cycles(Run& run, const std::string& name, const std::string& title,
                 const std::vector<std::string>& kinds, double noise, const ComparedLoops& compared,
                 const ComparedLoops* repeat);
// The strip at the turns of the clamps; nothing of a strip that stretches.
void draw_shapes(Run& run, const std::string& name, const std::string& title, const ComparedLoops& compared);

}  // namespace hysteron::experiments
