// `fit --kes-sheet`, `--fast-sheet`: what the virtual testers read of the fabric that was made from a sheet.
#pragma once

#include <string>
#include <vector>

#include "experiments/workbench/app/run.h"
#include "sim/identification/fast_sheet.h"
#include "sim/identification/kes_sheet.h"
#include "sim/scene/scene.h"

namespace hysteron::experiments {

// One number of the sheet beside the virtual tester's, in SI.
struct SheetReading {
  const char *quantity, *unit, *si;  // "B", the unit that sheets print, that of the numbers here
  SheetColumn column;
  double entered, read;
  const char* reason;  // where they may differ

  double difference() const { return 100 * (read / entered - 1); }  // [%]
};
// Every number of the sheet that a virtual tester reads in so many steps is there, along warp and weft.
std::vector<SheetReading> read_by_testers(const KesSheet& sheet, const Fabric& fabric, int steps = 2000);

// The same of a FAST sheet: its bending lengths by the elastica, its extensions.
std::vector<SheetReading> read_by_cantilever(const FastSheet& sheet, const Fabric& fabric);

// sheet.csv: what was entered beside what virtual testers read of the fabric along warp and weft, with the
// reason where they differ; the same as metrics.  Returns what a reader is told: that table, what was
// assumed, and the lines to go on with.
std::string report_sheet(Run& run, const LaboratorySheet& sheet, const SheetFabric& found,
                         const std::vector<SheetReading>& readings);

}  // namespace hysteron::experiments
