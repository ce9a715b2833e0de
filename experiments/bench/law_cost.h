// What the memory of `prandtl` costs and how exact it is: the table from which its defaults are chosen.
#pragma once

#include "experiments/workbench/app/options.h"
#include "experiments/workbench/app/run.h"
#include "sim/scene/scene.h"

namespace hysteron::experiments {

// One row per law and memory: largest and root-mean-square error of the moment over random histories [% of
// M0] against a stack of 64, nanoseconds per element and step on the scene's device, bytes of history per
// element.
std::vector<Metrics> law_cost_table(const Scene& scene, int elements);

// table.csv of these rows and, with pictures, plot_cost and plot_error with their captions in README.md.
void write_law_costs(Run& run, const std::vector<Metrics>& rows, bool pictures);

}  // namespace hysteron::experiments
