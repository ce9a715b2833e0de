// The page of an experiment that is asked for several laws, fabrics or integrators: OUT/<name>/ as the
// experiment alone would write it, and table.csv, sheet.png and plots for all.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "experiments/workbench/compare/table_plot.h"
#include "experiments/workbench/compare/variants.h"

namespace hysteron::experiments {

struct VariantPage {
  std::string title;                 // "Crease recovery"
  Setup setup;                       // of the line without lists
  Json keys;                         // what else the manifest keeps
  std::vector<std::string> metrics;  // of the table; the first stand behind the columns' names
  std::vector<TablePlot> plots;      // titled by the page
  std::string picture{};             // in a column's folder; "": the last of its frames
};

// Keys of such a page, which run_variants() takes off the line, for Experiment::own_keys.
std::vector<KeyDescription> page_keys();

// Runs the experiment `once`, or its page where the line names several variants.  `first_page` makes it from
// the line without lists, and may change the variants.  A column that cannot go on has its message in the
// table. Throws Error::invalid_input, and Error::system where that happens to a column.  Returns the exit
// code.
int run_variants(const CommandLine& line, void (*once)(const CommandLine&),
                 VariantPage (*first_page)(const CommandLine& first, std::vector<Variant>& variants));

}  // namespace hysteron::experiments
