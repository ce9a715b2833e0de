// Curves and maps of a study.
#pragma once

#include <string>
#include <vector>

#include "experiments/sweep/study.h"
#include "experiments/workbench/app/run.h"
#include "experiments/workbench/compare/sweep_columns.h"

namespace hysteron::experiments {

// Of each metric: plot_METRIC-KEY, a curve over each axis of numbers (dots: runs; lines: means over repeated
// draws), one colour for each value of another axis, one panel for the others; plot_METRIC-map, a map over
// the two longest axes of a grid.  Axes of texts alone become bars.
void plot_study(Run& run, const Study& study, const std::vector<ChildRun>& runs,
                const std::vector<std::string>& metrics);

}  // namespace hysteron::experiments
