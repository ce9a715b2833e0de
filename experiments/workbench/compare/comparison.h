// A comparison from its columns to its table, as every page of several variants has it.
#pragma once

#include <string>
#include <vector>

#include "experiments/workbench/app/run.h"
#include "experiments/workbench/compare/sweep_columns.h"

namespace hysteron::experiments {

// What the runs that a page sets side by side warn of, as warnings of the page itself.
class ColumnWarnings {
 public:
  // What the run's manifest warns of, and why it could not go on.
  void hear(const ChildRun& column);
  void hear(const std::string& name, const std::vector<std::string>& texts);
  // Each text once, with the names of the runs that give it: "linear, dahl: in 3 parts of steps ...".  Of
  // many texts the first, and how many there are.
  void say(Run& run) const;

 private:
  struct Heard {
    std::string text;
    std::vector<std::string> names;
  };
  std::vector<Heard> heard_;  // as they came
};

// Throws what a column would refuse before its first step, as far as its keys say it, with its name.
void check_columns(const std::vector<ChildRun>& columns);

// Runs the columns; how far they are and how they end is the run's progress.  Warns of `metrics`, those that
// the page is to show, which the first column that is complete has not found: others may find more.  Throws
// what run_columns() of sweep_columns.h throws.
void run_columns(Run& run, std::vector<ChildRun>& columns, const SweepJobs& jobs,
                 const std::vector<std::string>& metrics = {});

// Names of the metrics that are `wanted`, each once.
std::vector<std::string> metrics_in(const std::vector<ChildRun>& columns, bool (*wanted)(const MetricValue&));

// table.csv: `varied` heads the first column, "law", "fabric".  Then one for each of the metrics, numbers and
// texts, or of all numbers that any column of the comparison has, in the order in which they come, and
// `stopped`.  Each becomes the run's metric NAME.metric.  Throws Error::system if the file cannot be
// written.
void write_comparison_table(Run& run, const std::string& varied, const std::vector<ChildRun>& columns,
                            const std::vector<std::string>& metrics = {});

}  // namespace hysteron::experiments
