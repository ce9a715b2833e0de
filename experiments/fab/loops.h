// Loops of a FAB tester beside simulated ones: metrics, tables and plots, for `fab` and `fit --fab`.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "experiments/fab/sheet.h"
#include "experiments/workbench/app/run.h"
#include "render/plot.h"
#include "sim/reference/fab_test.h"

namespace hysteron::experiments {

// Measured loops (forces are NaN where nobody measured) and a run along their way.
struct ComparedLoops {
  FabLoops loops;
  FabRun run;
  bool measured = true;
  double zero = 0;                // of the measured force, found by this run [N/m]
  std::optional<SheetRun> sheet;  // along the same way, if one was asked for

  ComparedLoops(FabLoops loops, FabRun run, bool measured);
  BranchForces measured_forces() const;  // from that zero [N/m]
};

// `si` | `fab`; Error::request for others.
TesterUnits tester_units(const std::string& name);

struct CycleReading {
  const char* what;  // "area"
  std::string name;  // "area_cycle1_J_per_m"
  double value;
};
// Of one cycle, the first being 0: area, peak_force, force_range.
std::vector<CycleReading> readings(const FabLoops& loops, const BranchForces& force, int cycle);

// Those, also as measured_... and sheet_..., rms, zero, energy balance.
void add_metrics(Run& run, const ComparedLoops& compared);
// In the columns that `fit --fab` reads, the measured force and the sheet's behind.
void write_loops(Run& run, const std::string& name, const ComparedLoops& compared);
// Force [N/m] against distance [mm] of both branches of a cycle, one behind the other, without a label.
render::Series series_of(const FabLoops& loops, const BranchForces& force, int cycle,
                         render::Series::Style style);
void draw_loops(Run& run, const std::string& name, const std::string& title, const ComparedLoops& compared);
// The strip at the turns of the clamps, and the sheet's edge; nothing of a strip that stretches.
void draw_shapes(Run& run, const std::string& name, const std::string& title, const ComparedLoops& compared);

}  // namespace hysteron::experiments
