// Many small cloths that advance together, against one at a time.
#pragma once

#include <functional>
#include <vector>

#include "experiments/workbench/app/manifest.h"
#include "sim/scene/scene.h"

namespace hysteron::experiments {

struct BatchChoice {
  std::vector<double> cloths;  // how many together
  int threads = 4;             // of the host, which share the cloths
  double after = 0.1;          // simulated from the start before steps are timed [s]
  int steps = 9;               // that are timed, of every cloth
};

// Cloths whose b1 takes sixteen values in turn, up to half more than the scene's.  First four cloths one
// after the other, then as many together as `choice.cloths` says, a row each: the wall clock of one step of
// all, from the first that begins to the last that ends; cloths times steps per second; how many times that
// is the rate of one at a time; and how many of the four that ran alone, as far as they are among them, have
// the same state, bit for bit.  `measured` hears of every row at once.
std::vector<Metrics> times_together(const Scene& scene, const BatchChoice& choice,
                                    const std::function<void(const Metrics&)>& measured);

}  // namespace hysteron::experiments
