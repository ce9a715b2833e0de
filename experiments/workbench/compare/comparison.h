// Runs a comparison from its columns to its table, for every page of several variants.
#pragma once

#include <string>
#include <vector>

#include "experiments/workbench/app/run.h"
#include "experiments/workbench/compare/sweep_columns.h"

namespace hysteron::experiments {

// Collects the warnings of the runs that a page sets side by side, as warnings of the page itself.
class ColumnWarnings {
 public:
  // Adds the warnings of the run's manifest, and why it could not go on.
  void add(const ChildRun& column);
  void add(const std::string& name, const std::vector<std::string>& texts);
  // Emits each text once, with the names of the runs that gave it: "linear, dahl: in 3 parts of steps ...".
  // Of many texts it emits the first and their number.
  void emit(Run& run) const;

 private:
  struct Heard {
    std::string text;
    std::vector<std::string> names;
  };
  std::vector<Heard> heard_;  // in the order of arrival
};

// Runs the columns and reports their progress as the run's.  Warns of those of the page's `metrics` that the
// first complete column lacks, though others may have them.  Throws what run_columns() of sweep_columns.h
// throws.
void run_columns(Run& run, std::vector<ChildRun>& columns, const SweepJobs& jobs,
                 const std::vector<std::string>& metrics = {});

// Returns the names of the metrics that are `wanted`, each once.
std::vector<std::string> metrics_in(const std::vector<ChildRun>& columns, bool (*wanted)(const MetricValue&));

// Writes table.csv: the first column is headed `varied`, "law" or "fabric".  Then follows one for each of the
// metrics, numbers and texts, or for all numbers that any column of the comparison has, in their order, and
// `stopped`.  Each becomes the run's metric NAME.metric.  Throws Error::system if the file cannot be written.
void write_comparison_table(Run& run, const std::string& varied, const std::vector<ChildRun>& columns,
                            const std::vector<std::string>& metrics = {});

}  // namespace hysteron::experiments
