// How the time of a step grows with the number of triangles, beside the time that moving its bytes would
// take.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "experiments/workbench/app/run.h"
#include "sim/scene/scene.h"

namespace hysteron::experiments {

struct SizeChoice {
  std::vector<double> triangles;
  std::vector<Integrator> integrators;
  int steps = 9;        // that are timed, each by itself
  double budget = 120;  // of wall clock [s]
};

struct SizeTable {
  std::vector<Metrics> rows;
  std::string device;         // "": nothing was measured
  double copy_bandwidth = 0;  // bytes read plus written [byte/s]
};

// A row for each number of triangles, ascending, and each integrator, in this order; `measured`
// hears of every one at once.
//
// The scene's cloth first falls for 0.2 s; the steps that are timed go on from that shape, at rest.  Explicit
// steps are as long as is stable, at most the scene's: where it is divided, a row tells of one substep. Steps
// that are implicit in all forces take 1/60 s.  The floor is what the loops state that they must move over
// the bandwidth of a plain copy.  Rows that would not fit into the budget, by what they took with fewer
// triangles, and rows that cannot go on say so in `skipped`; their numbers are not known.
SizeTable times_by_size(const Scene& scene, const SizeChoice& choice,
                        const std::function<void(const Metrics&)>& measured);

// table.csv and, with pictures, plot_sizes with its caption in README.md.
void write_sizes(Run& run, const SizeTable& table, bool pictures);

}  // namespace hysteron::experiments
