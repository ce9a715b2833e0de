// Compares the folds of drapes with those of real cloth, because a coefficient alone does not show whether a
// drape looks like one.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/workbench/app/run.h"
#include "render/plot.h"

namespace hysteron::experiments {

// The range of folds of real drapes with this coefficient [%], 300 mm on 180 mm, between the two neighbouring
// fabrics.
struct FoldRange {
  double fewest, most;

  bool has(double folds) const { return folds >= fewest && folds <= most; }
};
FoldRange real_folds(double coefficient);

struct CountedDrape {
  std::string fabric, law;
  double coefficient, folds;  // coefficient [%], number of folds
};
// Reads a study's table.csv and leaves out rows without a coefficient.  Throws as read_table() and
// Table::at() do.
std::vector<CountedDrape> read_counted(const std::filesystem::path& csv);

// Returns a box for each fabric of the real drapes; the first has the label.
std::vector<render::Series> real_drape_boxes(const std::string& label);

// Draws plot_folds, and adds for each fabric and law the share of its drapes within the range.
void compare_folds(Run& run, const std::vector<CountedDrape>& drapes, bool pictures);

}  // namespace hysteron::experiments
