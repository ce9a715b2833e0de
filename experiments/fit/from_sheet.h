// `fit --kes-sheet` and `--fast-sheet` check the fabric made from a sheet by what the virtual testers read of
// it.
#pragma once

#include <string>
#include <vector>

#include "experiments/workbench/app/run.h"
#include "sim/identification/fast_sheet.h"
#include "sim/identification/kes_sheet.h"
#include "sim/scene/scene.h"

namespace hysteron::experiments {

// One number of the sheet and the virtual tester's, in SI.
struct SheetReading {
  const char *quantity, *unit, *si;  // "B", its unit on sheets, its SI unit here
  SheetColumn column;
  double entered, read;
  const char* reason;  // why they may differ

  double difference() const { return 100 * (read / entered - 1); }  // relative difference [%]
};
// Returns every number of the sheet that a virtual tester reads in so many steps, along warp and weft.
std::vector<SheetReading> read_by_testers(const KesSheet& sheet, const Fabric& fabric, int steps = 2000);

// Returns the same for a FAST sheet: its bending lengths by the elastica, and its extensions.
std::vector<SheetReading> read_by_cantilever(const FastSheet& sheet, const Fabric& fabric);

// Writes sheet.csv and metrics: the entered numbers, what virtual testers read of the fabric along warp and
// weft, and the reason where they differ.  Returns the printed summary: that table, the assumptions, and the
// next commands.
std::string report_sheet(Run& run, const LaboratorySheet& sheet, const SheetFabric& found,
                         const std::vector<SheetReading>& readings);

}  // namespace hysteron::experiments
