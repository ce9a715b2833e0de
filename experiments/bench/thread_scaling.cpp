#include "experiments/bench/thread_scaling.h"

#include <fmt/core.h>

#include <algorithm>

#include "render/color_map.h"

namespace hysteron::experiments {
namespace {

using render::Series;

constexpr std::size_t kKernelsShown = 5;

double us_of(const StepProfile& profile, const std::string& kernel) {
  for (const Metrics& row : profile.kernels)
    if (row["kernel"].text() == kernel) return row.number("us_per_step");
  return NAN;
}

Series ideal(const Series& measured) {
  Series line{"", measured.x, {}, Series::Style::dashed, measured.color};
  for (const double threads : measured.x) line.y.push_back(measured.y[0] * measured.x[0] / threads);
  return line;
}

}  // namespace

ThreadProfile profile_with(int threads, Scene scene, const Cloth& cloth, int steps) {
  scene.threads = threads;
  const auto simulation = make_simulation(scene, cloth);
  ThreadProfile result{threads, simulation->device(), {}, profile_of_steps(*simulation, steps)};
  result.state_hash = fmt::format("{:016x}", simulation->state_hash());
  return result;
}

std::vector<int> threads_within(const std::vector<double>& numbers, int processors) {
  std::vector<int> threads;
  for (const double number : numbers)
    if (number <= processors) threads.push_back(static_cast<int>(number));
  return threads;
}

render::Plot thread_plot(const std::vector<ThreadProfile>& profiles) {
  render::Plot plot{
      "Time of a step by threads; dashed: shared evenly", {"threads", true}, {"time per step [ms]", true}};
  const auto add = [&](const std::string& label, const auto& ms_of) {
    Series measured{label, {}, {}, Series::Style::line_and_points};
    measured.color = render::hex(render::method_color(plot.series.size() / 2));
    for (const ThreadProfile& of : profiles) {
      measured.x.push_back(of.threads);
      measured.y.push_back(ms_of(of.profile));
    }
    Series even = ideal(measured);
    plot.series.push_back(std::move(measured));
    plot.series.push_back(std::move(even));
  };
  add("the step", [](const StepProfile& profile) { return profile.step.number("ms_per_step"); });
  const std::vector<Metrics>& slowest = profiles.front().profile.kernels;
  for (std::size_t k = 0; k < std::min(kKernelsShown, slowest.size()); ++k) {
    const std::string kernel = slowest[k]["kernel"].text();
    add(kernel, [&](const StepProfile& profile) { return 1e-3 * us_of(profile, kernel); });
  }
  return plot;
}

}  // namespace hysteron::experiments
