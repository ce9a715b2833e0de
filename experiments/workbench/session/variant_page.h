// Writes the page of an experiment for several laws, fabrics or integrators: OUT/<name>/ as the experiment
// alone would write it, and table.csv, sheet.png and plots for all.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "experiments/workbench/compare/table_plot.h"
#include "experiments/workbench/compare/variants.h"

namespace hysteron::experiments {

struct VariantPage {
  std::string title;                 // title of the page: "Crease recovery"
  Setup setup;                       // from the line without lists
  Json keys;                         // further entries of the manifest
  std::vector<std::string> metrics;  // in the table; the first are shown behind the columns' names
  std::vector<TablePlot> plots;      // their titles come from the page
  std::string picture{};             // in a column's folder; "": the last of its frames
};

// Returns the keys of such a page, which run_variants() removes from the line, for Experiment::own_keys.
std::vector<KeyDescription> page_keys();

// Runs the experiment `once`, or its page if the line names several variants.  `first_page` makes it from the
// line without lists, and may change the variants.  A column that cannot go on has its message in the table.
// Throws Error::invalid_input and Error::system for a column that is wrong or fails.  Returns the exit code.
int run_variants(const CommandLine& line, int (*once)(const CommandLine&),
                 VariantPage (*first_page)(const CommandLine& first, std::vector<Variant>& variants));

}  // namespace hysteron::experiments
