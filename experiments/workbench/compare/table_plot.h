// Draws the tables of runs: two columns of a table in each run's folder as a line, or the rows of a table by
// the values of an x and a y column as maps, with a panel for the values of others.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "experiments/workbench/app/run.h"
#include "experiments/workbench/compare/sweep_columns.h"
#include "render/heat_map.h"
#include "render/plot.h"
#include "sim/base/csv.h"

namespace hysteron::experiments {

struct TablePlot {
  std::string name;   // name of its files
  render::Plot plot;  // plot without the table's series
  std::string file, x, y;
  render::Series::Style style = render::Series::Style::line;
  double scale = 1;    // of y, from the table's unit to the axis'
  std::string knee{};  // the metric of Curve::knee, whose place is marked; "": none
};

// Draws one run, from its own folder: "prandtl, simulated" in its law's colour.
void draw(Run& run, TablePlot plot, const std::string& law);
// A line for each column of a comparison that has the file and rows in it, named as column_labels() has it.
// Those that are zero throughout are named below the title instead, and lines that lie on each other are one;
// a plot without lines is not drawn.  Where the columns were repeated at half the step (--errors), a band as
// wide as that changes them lies around the lines.
void draw(Run& run, TablePlot plot, const std::vector<ChildRun>& columns,
          const std::vector<std::string>& names = {});

struct MapColumns {
  std::vector<std::string> panels;  // columns whose values title a map: "implicit, prandtl"
  std::string x, y;
};

// Adds the table's maps and its values along both axes to a page, in their order; `cell` makes a cell from
// the indices of its rows.
void add_maps(render::HeatMaps& page, const Table& table, const MapColumns& columns,
              const std::function<render::HeatMapCell(const std::vector<std::size_t>& rows)>& cell);

}  // namespace hysteron::experiments
