// What the sheet says of the elastica: differences, and how much of them its mesh and its steps make.
#pragma once

#include <string>

#include "experiments/fab/loops.h"

namespace hysteron::experiments {

// Two repeats of a test by which its errors are known.
struct SheetRepeats {
  SheetRun coarse;       // with a quarter of the triangles
  SheetRun far_apart;    // and with every second row only, the turns of the clamps included
  FabLoops every_other;  // those rows
};
// `shape`: that of the test itself.
SheetRepeats repeated(const FabLoops& loops, const Fabric& fabric, SheetShape shape);

// sheet_area_cycle1_J_per_m_difference_percent, ..._mesh_error, ..._step_error and their like.
void add_sheet_metrics(Run& run, const ComparedLoops& compared, const SheetRepeats& repeats);
// plot_difference: of the forces, sheet less elastica.
void draw_difference(Run& run, const std::string& title, const ComparedLoops& compared);
// A line per cycle on stdout.
void print_sheet(const ComparedLoops& compared, const SheetRepeats& repeats);

}  // namespace hysteron::experiments
