// What a study has found, as tables, a row a run and a row for each point of the axes over its repeated
// draws; and as curves and maps.
#pragma once

#include <cmath>
#include <span>

#include "experiments/sweep/study.h"
#include "experiments/workbench/app/run.h"
#include "experiments/workbench/compare/sweep_columns.h"
#include "sim/base/csv.h"

namespace hysteron::experiments {

// Of the runs' columns, in their order: `run`, a column for each axis, each metric that any of them has in
// the order in which they come (truths as 0 and 1), `wall_s` and `state_hash` of its manifest, `exit_code`,
// `stopped`: why it is not complete.  What is not known is empty.
Table table_of_runs(const Study& study, const std::vector<ChildRun>& runs);

// The metrics that the study names, or the headlines of its experiment, or those that the runs' scenes ask
// for, or else the first few that differ between runs; of those that any run has.
std::vector<std::string> metrics_shown(const Study& study, const std::vector<ChildRun>& runs);

// Says of the first metric that the study names and none of these runs has what it may have meant:
// "bending_frictoin_J (did you mean bending_friction_J?)"; "" where there is none, or no run has found
// anything.
std::string unknown_metric(const Study& study, std::span<const ChildRun> runs);

// Of the runs of equal values but for the seed: each axis, `draws`, and METRIC_mean with its standard error,
// METRIC_stderr, over those that have the metric.
Table table_of_means(const Study& study, const std::vector<ChildRun>& runs,
                     const std::vector<std::string>& metrics);

// The metric of each run; NaN where it is not known.
std::vector<double> metric_values(const std::vector<ChildRun>& runs, const std::string& metric);

// Mean and its standard error of those numbers that are known.
struct Mean {
  int count = 0;
  double value = NAN;
  double error = NAN;
};
Mean selected_mean(const std::vector<double>& numbers, const std::vector<std::size_t>& which);

// Of each metric: plot_METRIC-KEY, a curve over each axis of numbers (dots: runs; lines: means over repeated
// draws), one colour for each value of another axis, one panel for the others; plot_METRIC-map, a map over
// the two longest axes of a grid.  Axes of texts alone become bars.
void plot_study(Run& run, const Study& study, const std::vector<ChildRun>& runs,
                const std::vector<std::string>& metrics);

}  // namespace hysteron::experiments
