// Tables, metrics and maps of `hysteron stability`.
#pragma once

#include <string>
#include <vector>

#include "experiments/stability/limit.h"
#include "experiments/stability/stability.h"
#include "experiments/workbench/app/run.h"

namespace hysteron::experiments {

// cells.csv, a row for each cell; texts with commas are quoted.
void write_cells(Run& run, const std::vector<Sweep>& sweeps, const std::vector<Cell>& cells);
// cells, ended, retried, refused, diverged of all and of each integrator; diverged_default.
void write_counts(Run& run, const std::vector<Cell>& cells);
// plot_<sweep>: a map for each integrator and variant.
void draw_maps(Run& run, const std::vector<Sweep>& sweeps, const std::vector<Cell>& cells);

// limit.csv, limit_smallest_ratio and limit_largest_ratio.
void write_limits(Run& run, const std::vector<MeasuredLimit>& limits);

// On stdout.
void print_counts(const std::vector<Cell>& cells);

}  // namespace hysteron::experiments
