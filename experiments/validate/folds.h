// Fold counts of drapes against those of real cloth: a coefficient alone does not tell whether a drape looks
// like one.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/workbench/app/run.h"
#include "render/plot.h"

namespace hysteron::experiments {

// The range of folds that real drapes of this coefficient [%] have, 300 mm on 180 mm: between those of the
// two fabrics around it.
struct FoldRange {
  double fewest, most;

  bool has(double folds) const { return folds >= fewest && folds <= most; }
};
FoldRange real_folds(double coefficient);

struct CountedDrape {
  std::string fabric, law;
  double coefficient, folds;  // [%]
};
// Of a study's table.csv; those that have no coefficient are left out.  Throws as read_table() and
// Table::at() do.
std::vector<CountedDrape> read_counted(const std::filesystem::path& csv);

// What was counted on real drapes, a box for each fabric: its label on the first.
std::vector<render::Series> real_drape_boxes(const std::string& label);

// plot_folds; metrics: of each fabric and law the share of its drapes within.
void compare_folds(Run& run, const std::vector<CountedDrape>& drapes, bool pictures);

}  // namespace hysteron::experiments
