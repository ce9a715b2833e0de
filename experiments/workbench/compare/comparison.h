// A comparison from its columns to its table, as every page of several variants has it.
#pragma once

#include <string>
#include <vector>

#include "experiments/workbench/app/run.h"
#include "experiments/workbench/compare/sweep_columns.h"

namespace hysteron::experiments {

// Runs the columns; how far they are and how they end is the run's progress.  Throws what run_columns() of
// sweep_columns.h throws.
void run_columns(Run& run, std::vector<ChildRun>& columns, const SweepJobs& jobs);

// Names of the metrics that are `wanted`, each once.
std::vector<std::string> metrics_in(const std::vector<ChildRun>& columns, bool (*wanted)(const MetricValue&));

// Throws Error::invalid_input for a name that is no metric of any column, with those that there are; of
// columns none of which is complete, not all that would be there are known, and none is refused.
void check_metrics(const std::vector<ChildRun>& columns, const std::vector<std::string>& names);

// table.csv: `varied` heads the first column, "law", "fabric".  Then one for each of the metrics, numbers and
// texts, or of all numbers that any column of the comparison has, in the order in which they come, and
// `stopped`.  Each becomes the run's metric NAME.metric.  Throws Error::system if the file cannot be
// written.
void write_comparison_table(Run& run, const std::string& varied, const std::vector<ChildRun>& columns,
                            const std::vector<std::string>& metrics = {});

}  // namespace hysteron::experiments
