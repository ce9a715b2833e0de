// The folder of a fit: the fabric's file, the data beside the law, plots, metrics, and what is said of them.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "experiments/fit/identification.h"
#include "experiments/fit/stops.h"
#include "experiments/workbench/app/run.h"

namespace hysteron::experiments {

// What a fabric's file holds besides the fitted numbers.
struct FabricNotes {
  std::string name;                          // of the fabric
  std::string from;                          // one line: what it was identified from
  std::optional<double> density, thickness;  // [kg/m^2], [m]; none: another fabric's, marked as assumed
};

// A line for each number of the fabric's file that is another fabric's, because none was given.
std::vector<std::string> borrowed_warnings(const FabricNotes& notes);

// A file for read_fabric(); standard errors as `stderr` beside the values.
void write_fabric(const std::filesystem::path& file, const Identification& found, const FabricNotes& notes);

// Writes fabric.toml, fit.csv, both plots and the metrics into the run.  Of several laws the first is the
// best; metrics are then called `<law>.<key>`.
void report_fits(Run& run, const std::vector<Identification>& fits, const FabricNotes& notes);

// plot_fit and plot_residual; a panel for each of several laws.
void draw_fits(Run& run, const std::vector<Identification>& fits, const std::string& title);

// stops.csv, and the metrics of the elements.
void report_stops(Run& run, const std::vector<Stop>& stops);

// What a reader is told: a line per law if there are several; of the best, numbers with standard errors, what
// is undetermined, statements.
std::string summary(const std::vector<Identification>& fits);

}  // namespace hysteron::experiments
