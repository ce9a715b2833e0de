#include "experiments/bench/step_profile.h"

#include <algorithm>

namespace hysteron::experiments {
namespace {

Metrics kernel_row(const std::string& name, const KernelCost& cost, int steps, double all_seconds,
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

StepCost cost_of_steps(Simulation& simulation, int batches, int steps, int parts) {
  const Diagnostics before = simulation.counts();
  std::vector<double> ms;
  simulation.wait();
  for (int batch = 0; batch < batches; ++batch) {
    const Stopwatch clock;
    simulation.advance(steps);
    simulation.wait();
    ms.push_back(1e3 * clock.seconds() / steps / parts);
  }
  std::sort(ms.begin(), ms.end());
  const Diagnostics after = simulation.counts();
  const DeviceCounts work = after.device - before.device;
  const auto of_one = [&](long count) { return static_cast<double>(count) / batches / steps / parts; };
  return {.ms = ms[ms.size() / 2],
          .ms_fastest = ms.front(),
          .ms_slowest = ms.back(),
          .launches = of_one(work.loops),
          .synchronizations = of_one(work.synchronizations),
          .allocations = of_one(work.allocations),
          .newton_iterations = of_one(after.newton - before.newton),
          .solver_iterations = of_one(after.linear - before.linear)};
}

void set(Metrics& row, const StepCost& cost) {
  row.set("ms_per_step", cost.ms);
  row.set("ms_per_step_fastest", cost.ms_fastest);
  row.set("ms_per_step_slowest", cost.ms_slowest);
  row.set("launches_per_step", cost.launches);
  row.set("synchronizations_per_step", cost.synchronizations);
  row.set("allocations_per_step", cost.allocations);
  row.set("newton_iterations_per_step", cost.newton_iterations);
  row.set("solver_iterations_per_step", cost.solver_iterations);
}

Table metrics_table(const std::vector<Metrics>& rows) {
  Table table;
  for (const auto& [key, value] : rows.front()) table.head.push_back(key);
  for (const Metrics& row : rows) {
    std::vector<Cell> cells;
    for (const auto& [key, value] : row)
      cells.push_back(value.is_text() ? Cell(value.text()) : Cell(value.number()));
    table.row(cells);
  }
  return table;
}

KernelCosts loops_of_steps(Simulation& simulation, int steps) {
  simulation.profile();
  simulation.advance(steps);
  return simulation.kernel_costs();
}

double stated_bytes(const KernelCosts& costs) {
  double bytes = 0;
  for (const auto& [name, cost] : costs) bytes += cost.bytes;
  return bytes;
}

StepProfile profile_of_steps(Simulation& simulation, int steps) {
  simulation.advance(steps);  // warms the caches and leaves the start
  const double ms = cost_of_steps(simulation, 1, steps).ms;
  simulation.profile();
  const StepCost cost = cost_of_steps(simulation, 1, steps);
  const KernelCosts costs = simulation.kernel_costs();
  const double bandwidth = simulation.copy_bandwidth();

  KernelCost all;
  for (const auto& [name, kernel] : costs) all.seconds += kernel.seconds;
  StepProfile profile;
  for (const auto& [name, kernel] : costs)
    profile.kernels.push_back(kernel_row(name, kernel, steps, all.seconds, bandwidth));
  std::sort(profile.kernels.begin(), profile.kernels.end(), [](const Metrics& a, const Metrics& b) {
    return a.number("us_per_step") > b.number("us_per_step");
  });
  const double bytes = stated_bytes(costs) / steps;
  profile.step = {{"steps", steps},
                  {"ms_per_step", ms},
                  {"ms_per_step_profiled", cost.ms},
                  {"ms_per_step_in_kernels", 1e3 * all.seconds / steps},
                  {"launches_per_step", cost.launches},
                  {"synchronizations_per_step", cost.synchronizations},
                  {"allocations_per_step", cost.allocations},
                  {"newton_iterations_per_step", cost.newton_iterations},
                  {"solver_iterations_per_step", cost.solver_iterations},
                  {"us_per_launch", 1e6 * simulation.launch_seconds()},
                  {"bytes_per_step", bytes},
                  {"copy_bandwidth_GB_per_s", 1e-9 * bandwidth},
                  {"fraction_of_copy_bandwidth", bytes / (1e-3 * ms) / bandwidth}};
  return profile;
}

}  // namespace hysteron::experiments
