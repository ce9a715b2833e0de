#include "experiments/bench/step_profile.h"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace hysteron::experiments {
namespace {

Metrics row_of(const std::string& name, const KernelCost& cost, int steps, double all_seconds,
               double bandwidth) {
  const double calls = static_cast<double>(cost.calls);
  const double stated = cost.bytes > 0 ? cost.bytes : NAN;
  return {{"kernel", name},
          {"calls_per_step", calls / steps},
          {"us_per_call", 1e6 * cost.seconds / calls},
          {"us_per_step", 1e6 * cost.seconds / steps},
          {"share_percent", 100 * cost.seconds / all_seconds},
          {"bytes_per_call", stated / calls},
          {"fraction_of_copy_bandwidth", stated / cost.seconds / bandwidth}};
}

}  // namespace

double ms_per_step(Simulation& simulation, int steps) {
  simulation.wait();
  const auto start = std::chrono::steady_clock::now();
  simulation.advance(steps);
  simulation.wait();
  return 1e3 * std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() / steps;
}

StepProfile profile_of_steps(Simulation& simulation, int steps) {
  simulation.advance(steps);  // warm caches, and away from the start
  const double ms = ms_per_step(simulation, steps);
  simulation.profile();
  const DeviceCounts before = simulation.device_work();
  const SolverCounts solved_before = simulation.solver_counts();
  const double ms_profiled = ms_per_step(simulation, steps);
  const DeviceCounts work = simulation.device_work() - before;
  const SolverCounts solved = simulation.solver_counts();
  const KernelCosts costs = simulation.kernel_costs();
  const double bandwidth = simulation.copy_bandwidth();

  KernelCost all;
  for (const auto& [name, cost] : costs) all.seconds += cost.seconds;
  StepProfile profile;
  for (const auto& [name, cost] : costs)
    profile.kernels.push_back(row_of(name, cost, steps, all.seconds, bandwidth));
  std::sort(profile.kernels.begin(), profile.kernels.end(), [](const Metrics& a, const Metrics& b) {
    return a.number("us_per_step") > b.number("us_per_step");
  });
  const auto per_step = [&](long count) { return static_cast<double>(count) / steps; };
  profile.step = {{"steps", steps},
                  {"ms_per_step", ms},
                  {"ms_per_step_profiled", ms_profiled},
                  {"ms_per_step_in_kernels", 1e3 * all.seconds / steps},
                  {"launches_per_step", per_step(work.loops)},
                  {"synchronizations_per_step", per_step(work.synchronizations)},
                  {"allocations_per_step", per_step(work.allocations)},
                  {"newton_iterations_per_step", per_step(solved.newton - solved_before.newton)},
                  {"solver_iterations_per_step", per_step(solved.linear - solved_before.linear)},
                  {"us_per_launch", 1e6 * simulation.launch_seconds()},
                  {"copy_bandwidth_GB_per_s", 1e-9 * bandwidth}};
  return profile;
}

}  // namespace hysteron::experiments
