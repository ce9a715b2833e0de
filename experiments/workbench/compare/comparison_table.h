// table.csv of a page that compares: a row for each variant.
#pragma once

#include <string>
#include <vector>

#include "experiments/workbench/app/run.h"

namespace hysteron::experiments {

struct ComparisonRow {
  std::string name;
  Metrics metrics;      // what is no number is left out
  std::string stopped;  // why it could not go on; empty: complete
};

// `varied` heads the first column: "law", "fabric".  Then a column for each metric that any row has, in the
// order in which they come, and `stopped`.  Each number becomes the run's metric NAME.metric.  Throws
// Error::machine if the file cannot be written.
void write_comparison_table(Run& run, const std::string& varied, const std::vector<ComparisonRow>& rows);

}  // namespace hysteron::experiments
