// Declares the functions that the CPU build and the GPU build of the numerical sources each offer to host
// code.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "sim/bending/curvature_operator.h"
#include "sim/time/simulation.h"

namespace hysteron {

inline constexpr int kMaxMovingPins = 12;  // their placements travel with a kernel launch by value

std::unique_ptr<Simulation> make_cpu_simulation(const Scene&, const Cloth&, const CurvatureOperator&,
                                                const StepLimits&);
std::unique_ptr<Simulation> make_gpu_simulation(const Scene&, const Cloth&, const CurvatureOperator&,
                                                const StepLimits&);

// Returns a bound on dM/dK of the scene's law on an element of this dimension [N m].
double law_largest_stiffness(const Scene& scene, const CurvatureOperator& op);

// Runs jobs that take turns on the calling thread (together.h).
void run_on_gpu_together(int count, const std::function<void(int)>& job);

std::string cpu_description();
int gpu_count(std::string& reason);  // usable GPUs; `reason` says why there are none
std::string gpu_description(int index);

}  // namespace hysteron
