// The folder of a fit: the fabric's file, the data beside the law, plots, metrics, and what is said of them.
#pragma once

#include <string>
#include <vector>

#include "experiments/workbench/app/run.h"
#include "sim/identification/fabric_file.h"

namespace hysteron::experiments {

// Writes fabric.toml, fit.csv, both plots and the metrics into the run.  Of several laws the first is the
// best; metrics are then called `<law>.<key>`.
void report_fits(Run& run, const std::vector<Identification>& fits, const FabricNotes& notes);

// What a reader is told: a line per law if there are several; of the best, numbers with standard errors, what
// is undetermined, statements.
std::string summary(const std::vector<Identification>& fits);

}  // namespace hysteron::experiments
