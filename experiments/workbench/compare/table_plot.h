// A plot of what runs have written: two columns of a table in each run's folder.
#pragma once

#include <string>
#include <vector>

#include "experiments/workbench/app/run.h"
#include "experiments/workbench/compare/sweep_columns.h"
#include "render/plot.h"

namespace hysteron::experiments {

struct TablePlot {
  std::string name;   // of its files
  render::Plot plot;  // still without the table's series
  std::string file, x, y;
  render::Series::Style style = render::Series::Style::line;
  double scale = 1;  // of y, from the table's unit to the axis'
};

// Of one run, from its own folder.
void draw(Run& run, TablePlot plot, const std::string& label);
// A line for each column of a comparison that has the file and rows in it.  Those that are zero throughout
// are named below the title instead, and lines that lie on each other are one; a plot without lines is not
// drawn.
void draw(Run& run, TablePlot plot, const std::vector<ChildRun>& columns);

}  // namespace hysteron::experiments
