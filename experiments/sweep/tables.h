// Returns the results of a study as tables, with a row for each run or for each point of the axes over its
// repeated draws, and as curves and maps.
#pragma once

#include <cmath>
#include <span>

#include "experiments/sweep/study.h"
#include "experiments/workbench/app/run.h"
#include "experiments/workbench/compare/sweep_columns.h"
#include "sim/base/csv.h"

namespace hysteron::experiments {

// Returns a row for each run, in order, with the columns `run`, each axis, each metric that any run has
// (booleans as 0 and 1), `wall_s` and `state_hash` of its manifest, `exit_code`, and `stopped`, why it is not
// complete.  Unknown fields are empty.
Table table_of_runs(const Study& study, const std::vector<ChildRun>& runs);

// Returns those metrics that any run has: of the study's own, or else of its experiment's headlines, or of
// those that the runs' scenes request, or else the first few that differ between runs.
std::vector<std::string> metrics_shown(const Study& study, const std::vector<ChildRun>& runs);

// Returns a text on the first metric that the study names and none of these runs has: "bending_frictoin_J
// (did you mean bending_friction_J?)"; "" if there is none, or no run has any metric.
std::string unknown_metric(const Study& study, std::span<const ChildRun> runs);

// Returns a row for the runs that differ in the seed alone: each axis, `draws`, and METRIC_mean with its
// standard error, METRIC_stderr, over those that have the metric.
Table table_of_means(const Study& study, const std::vector<ChildRun>& runs,
                     const std::vector<std::string>& metrics);

// Returns the metric of each run; NaN if unknown.
std::vector<double> metric_values(const std::vector<ChildRun>& runs, const std::string& metric);

// The mean of the known numbers, and its standard error.
struct Mean {
  int count = 0;
  double value = NAN;
  double error = NAN;
};
Mean selected_mean(const std::vector<double>& numbers, const std::vector<std::size_t>& which);

// Draws for each metric plot_METRIC-KEY, a curve over each numeric axis (dots: runs; lines: means over
// repeated draws) with a colour for each value of another axis and a panel for each of the others; and
// plot_METRIC-map over the two longest axes of a grid.  Axes of texts alone become bars.
void plot_study(Run& run, const Study& study, const std::vector<ChildRun>& runs,
                const std::vector<std::string>& metrics);

}  // namespace hysteron::experiments
