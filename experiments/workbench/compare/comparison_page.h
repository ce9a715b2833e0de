// What finished columns of a comparison show, on one page.
#pragma once

#include <string>
#include <vector>

#include "experiments/workbench/app/run.h"
#include "experiments/workbench/compare/sweep_columns.h"

namespace hysteron::experiments {

struct ComparisonPage {
  std::string title;
  std::vector<std::string> notes{};
  std::vector<std::string> names{};  // over the columns, in place of their own; empty: these
  int rows = 4;                      // instants, at most
  std::vector<double> times{};       // of the rows, in their place [s]; empty: spread over what moves
  std::vector<std::string> metrics;  // behind the columns' names and in bars; empty: those of column_heads()
  std::string look;                  // of the pictures
  std::string picture{};             // a file of each column's folder in place of them; "": none
  int to = -1;                       // the column that others differ from; -1: no differences
  bool curvature = false;            // what differs: curvature, as the columns pictured it, not pictures
  double onion = 0;                  // a row first with all instants up to then over each other [s]; 0: none
  bool outlines = true;              // of all columns, over each other
  std::vector<std::string> films{};  // film_formats(); none: no film
  double film_bytes = 4e6;           // of each file, at most
};

// Columns have pictures of `look` and, for outlines, silhouettes.  Writes sheet.png and films where they are
// asked for.
void draw_comparison_page(Run& run, const ComparisonPage& page, const std::vector<ChildRun>& columns);

// Each of the experiment's own columns of metrics.csv against time, a line a column of the page; the curves
// that its manifest's `curves` name; and bars of the page's metrics, or of what the experiment is asked for.
void plot_comparison(Run& run, const ComparisonPage& page, const std::vector<ChildRun>& columns);

}  // namespace hysteron::experiments
