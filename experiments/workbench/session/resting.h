// At the end of a run's motion: on to the equilibrium nearby, where there is one.
#pragma once

#include <string>
#include <vector>

#include "sim/time/simulation.h"

namespace hysteron::experiments {

// Largest distance of a vertex from where it was [m].
double farthest_moved(const std::vector<Eigen::Vector3d>& now, const std::vector<Eigen::Vector3d>& before);

struct Rest {
  double moved = 0;     // by the last step, a vertex at most [m]
  std::string failure;  // why none is near; "": the simulation is at rest
};
// Takes steps without inertia until one of them ends in equilibrium and moves no vertex farther than a
// hundredth of the thickness [m].  Where none does, the simulation is where it was, history, losses and
// counts included; it is only good for looking at then.
Rest seek_rest(Simulation& simulation, double thickness);
// From rest on for so long [s], from equilibrium to equilibrium, by steps that begin with `step` and grow to
// a fifth of the time passed.
void wait_at_rest(Simulation& simulation, double seconds, double step);

}  // namespace hysteron::experiments
