// Rows of numbers as table.csv.
#pragma once

#include <vector>

#include "experiments/workbench/app/run.h"

namespace hysteron::experiments {

// All rows have the keys of the first.
void write_table(Run& run, const std::vector<Metrics>& rows);

}  // namespace hysteron::experiments
