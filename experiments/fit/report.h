// Writes the folder of a fit: the fabric's file, the data beside the law, plots, metrics, and the summary.
#pragma once

#include <string>
#include <vector>

#include "experiments/workbench/app/run.h"
#include "sim/identification/fabric_file.h"

namespace hysteron::experiments {

// Writes fabric.toml, fit.csv, both plots and the metrics into the run.  The first of several laws is the
// best; metrics are then called `<law>.<key>`.
void report_fits(Run& run, const std::vector<Identification>& fits, const FabricNotes& notes);

// Returns the printed summary: a line per law if there are several; then the best one's numbers with standard
// errors, what is undetermined, and statements.
std::string summary(const std::vector<Identification>& fits);

}  // namespace hysteron::experiments
