// Measures how the time of a step grows with the number of triangles, beside the time that moving its bytes
// would take.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "experiments/workbench/app/run.h"
#include "sim/scene/scene.h"

namespace hysteron::experiments {

struct SizeParams {
  std::vector<double> triangles;
  std::vector<Integrator> integrators;
  int steps = 9;        // number of steps, each timed by itself
  double budget = 120;  // limit of the wall clock [s]
};

struct SizeTable {
  std::vector<Metrics> rows;
  std::string device;         // "" if nothing was measured
  double copy_bandwidth = 0;  // bytes read plus written [byte/s]
};

// Measures a row for each number of triangles, ascending, and each integrator, in this order; `measured` is
// called with every row at once.
//
// The scene's cloth first falls for 0.2 s; the timed steps go on from that shape, at rest.  Explicit steps
// are as long as is stable, at most the scene's: where the scene's step is divided, a row holds one substep.
// Steps that are implicit in all forces take 1/60 s.  The floor is the bytes that the loops state they must
// move, over the bandwidth of a plain copy.  Rows that would exceed the budget, extrapolated from fewer
// triangles, and rows that cannot go on give the reason in `skipped`; their numbers are unknown.
SizeTable times_by_size(const Scene& scene, const SizeParams& choice,
                        const std::function<void(const Metrics&)>& measured);

// Writes table.csv and, with pictures, plot_sizes with its caption in README.md.
void write_sizes(Run& run, const SizeTable& table, bool pictures);

}  // namespace hysteron::experiments
