// The kernels of a scene's steps under several numbers of a CPU's threads.
#pragma once

#include <string>
#include <vector>

#include "experiments/bench/step_profile.h"
#include "render/plot.h"
#include "sim/scene/cloth.h"

namespace hysteron::experiments {

struct ThreadProfile {
  int threads = 0;
  std::string device, state_hash;
  StepProfile profile;
};

ThreadProfile profile_with(int threads, Scene scene, const Cloth& cloth, int steps);

// Those of the numbers that a machine of so many processors has.
std::vector<int> threads_within(const std::vector<double>& numbers, int processors);

// Time of a step and of its slowest kernels; dashed: the first time, shared evenly by the threads.
render::Plot thread_plot(const std::vector<ThreadProfile>& profiles);

}  // namespace hysteron::experiments
