// What `hysteron accuracy` writes.
#pragma once

#include <vector>

#include "experiments/accuracy/front.h"
#include "experiments/workbench/app/run.h"

namespace hysteron::experiments {

// table.csv: a setting per row; orders.csv; cheapest.csv: what reaches kTargets in the least time.
inline constexpr double kTargets[] = {0.1, 0.03, 0.01, 0.003};
void write_accuracy(Run& run, const std::vector<Solution>& solutions);
// PROBLEM_front_count, PROBLEM_base_error_percent, PROBLEM_order_space, ...
void write_accuracy_metrics(Run& run, const std::vector<Solution>& solutions);
// plot_PROBLEM: error against seconds, the front marked.
void draw_accuracy(Run& run, const std::vector<Solution>& solutions);
// The tables on stdout.
void print_accuracy(const std::vector<Solution>& solutions);

}  // namespace hysteron::experiments
