// Continues from the end of a run's motion to the equilibrium nearby, if there is one.
#pragma once

#include <string>
#include <vector>

#include "sim/time/simulation.h"

namespace hysteron::experiments {

// Returns the largest displacement of a vertex [m].
double farthest_moved(const std::vector<Eigen::Vector3d>& now, const std::vector<Eigen::Vector3d>& before);

struct Rest {
  double moved = 0;     // largest displacement of a vertex by the last step [m]
  std::string failure;  // why there is no equilibrium nearby; "" if the simulation is at rest
};
// Takes steps without inertia until one of them ends in equilibrium and moves no vertex farther than a
// hundredth of the thickness [m].  If none does, the simulation returns to its previous state, including
// history, losses and counts; it may then only be read.
Rest seek_rest(Simulation& simulation, double thickness);
// Waits `seconds` [s] at rest, from equilibrium to equilibrium, by steps that begin with `step` [s] and grow
// to a fifth of the time passed.
void wait_at_rest(Simulation& simulation, double seconds, double step);

}  // namespace hysteron::experiments
