// Draws the results of a comparison's finished columns on one page.
#pragma once

#include <string>
#include <vector>

#include "experiments/workbench/app/run.h"
#include "experiments/workbench/compare/sweep_columns.h"

namespace hysteron::experiments {

struct ComparisonPage {
  std::string title;
  std::vector<std::string> notes{};
  std::vector<std::string> names{};  // names over the columns; empty: their own
  int rows = 4;                      // most instants
  std::vector<double> times{};       // times of the rows [s]; empty: spread by displacement
  // Shown behind the columns' names and in bars; empty: those of column_heads().
  std::vector<std::string> metrics;
  std::string look;        // look of the pictures
  std::string picture{};   // a file of each column's folder instead of its frames; "": none
  int to = -1;             // index of the column that is subtracted; -1: no differences
  bool curvature = false;  // subtracts curvatures, as the columns pictured them, not pictures
  double onion = 0;        // adds a first row with all instants up to this one superposed [s]; 0: none
  bool outlines = true;    // draws the outlines of all columns over each other
  std::vector<std::string> films{};  // as from film_formats(); none: no film
  double film_bytes = 4e6;           // largest size of each file [bytes]
};

// Writes sheet.png and the requested films.  Columns must have pictures of `look` and, for outlines,
// silhouettes.
void draw_comparison_page(Run& run, const ComparisonPage& page, const std::vector<ChildRun>& columns);

// Plots each of the experiment's own columns of metrics.csv against time, a line per column of the page; the
// curves that its manifest's `curves` name; and bars of the page's metrics, or of the experiment's headlines.
void plot_comparison(Run& run, const ComparisonPage& page, const std::vector<ChildRun>& columns);

}  // namespace hysteron::experiments
