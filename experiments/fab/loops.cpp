#include "experiments/fab/loops.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "render/plot.h"
#include "render/plot_page.h"
#include "sim/base/csv.h"
#include "sim/base/error.h"
#include "sim/identification/fab_cycles.h"

namespace hysteron::experiments {
namespace {

using Style = render::Series::Style;

constexpr const char* kCycleColors[] = {"#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9"};
constexpr double kMillimetre = 1e3;
constexpr const char *kMeasuredColor = "#777777", *kSimulatedColor = "#0072B2";

const char* cycle_color(int cycle) { return kCycleColors[cycle % std::size(kCycleColors)]; }

// Adds a strip's shape relative to the middle between its ends, which a shape and its mirror image share.
void add_line(const std::vector<Eigen::Vector2d>& line, double up, render::Series& series) {
  const double middle = (line.front().x() + line.back().x()) / 2;
  for (const Eigen::Vector2d& point : line) {
    series.add(kMillimetre * (point.x() - middle), kMillimetre * up * point.y());
  }
}

// Returns the rms over the branches from `first` to before `end`.
double rms_difference(const BranchForces& a, const BranchForces& b, std::size_t first, std::size_t end) {
  double sum = 0;
  std::size_t count = 0;
  for (std::size_t i = first; i < end; ++i)
    for (std::size_t k = 0; k < a[i].size(); ++k, ++count) sum += std::pow(a[i][k] - b[i][k], 2);
  return std::sqrt(sum / static_cast<double>(count));
}

// Returns the force [N/m] against the distance [mm] of both branches of a cycle as one curve without a label.
render::Series cycle_series(const FabLoops& loops, const BranchForces& force, int cycle,
                            render::Series::Style style) {
  render::Series series{.label = "", .x = {}, .y = {}, .style = style, .color = cycle_color(cycle)};
  for (int b = 2 * cycle; b <= 2 * cycle + 1; ++b)
    for (std::size_t i = 0; i < force[b].size(); ++i) {
      series.add(kMillimetre * loops.branches[b].distance[i], force[b][i]);
    }
  return series;
}

}  // namespace

ComparedLoops::ComparedLoops(FabLoops loops, FabRun run, bool measured)
    : loops(std::move(loops)), run(std::move(run)), measured(measured) {
  if (measured) zero = force_zero(this->loops, this->run.force);
}

BranchForces ComparedLoops::measured_forces() const {
  BranchForces forces = branch_forces(loops);
  for (auto& branch : forces)
    for (double& force : branch) force -= zero;
  return forces;
}

void add_metrics(Run& run, const ComparedLoops& compared) {
  const BranchForces measured = compared.measured_forces();
  for (int cycle = 0; cycle < compared.loops.cycles(); ++cycle) {
    const std::string of = "_cycle" + std::to_string(cycle + 1);
    const auto add = [&](const std::string& before, const BranchForces& force) {
      run.metric(before + "area" + of + "_J_per_m", loop_area(compared.loops, force, cycle));
      run.metric(before + "peak_force" + of + "_N_per_m", peak_force(compared.loops, force, cycle));
      run.metric(before + "force_range" + of + "_N_per_m", force_range(force, cycle));
    };
    add("", compared.run.force);
    if (compared.measured) add("measured_", measured);
  }
  if (compared.measured) {
    run.metric("difference_rms_N_per_m", rms_difference(compared.run.force, measured, 0, measured.size()));
    run.metric("measured_force_zero_N_per_m", compared.zero);
  }
  const FabRun& r = compared.run;
  run.metric("dissipated_J_per_m", r.dissipated);
  run.metric("energy_imbalance_percent", 100 * std::abs(r.work - r.stored - r.dissipated) /
                                             std::max(r.largest_work, std::abs(r.stored) + r.dissipated));
}

void write_loops(Run& run, const std::string& name, const ComparedLoops& compared) {
  const FabLoops& loops = compared.loops;
  std::vector<std::string> head = {"direction", "test",           "branch", "clamp_distance_m",
                                   "force_N",   "gauge_length_m", "width_m"};
  if (compared.measured) head.emplace_back("measured_force_N");
  Table table(head);
  const BranchForces measured = compared.measured_forces();
  for (std::size_t b = 0; b < loops.branches.size(); ++b)
    for (std::size_t i = 0; i < loops.branches[b].distance.size(); ++i) {
      std::vector<Cell> row = {loops.direction,
                               loops.test,
                               b,
                               loops.branches[b].distance[i],
                               compared.run.force[b][i] * loops.width,
                               loops.gauge,
                               loops.width};
      if (compared.measured) row.emplace_back(measured[b][i] * loops.width);
      table.row(row);
    }
  table.write(run.path(name));
}

void draw_loops(Run& run, const std::string& name, const std::string& title, const ComparedLoops& compared) {
  render::Plot plot{title, {"distance of the clamps [mm]"}, {"force per width, tension > 0 [N/m]"}};
  const BranchForces measured = compared.measured_forces();
  for (int cycle = 0; cycle < compared.loops.cycles(); ++cycle) {
    render::Series model = cycle_series(compared.loops, compared.run.force, cycle, Style::line);
    model.label = "cycle " + std::to_string(cycle + 1) +
                  fmt::format(", {:.3g} mJ/m", 1e3 * loop_area(compared.loops, compared.run.force, cycle));
    plot.series.push_back(model);
    if (!compared.measured) continue;
    render::Series data = cycle_series(compared.loops, measured, cycle, Style::points);
    data.label = fmt::format("measured, {:.3g} mJ/m", 1e3 * loop_area(compared.loops, measured, cycle));
    plot.series.push_back(data);
  }
  run.plot(name, plot);
}

namespace {

// The force on a branch at that distance, between the recorded ones; NaN beyond them.
double force_at(const FabBranch& branch, const std::vector<double>& force, double distance) {
  for (std::size_t i = 1; i < force.size(); ++i) {
    const double from = branch.distance[i - 1], to = branch.distance[i];
    if (from == to || (distance - from) * (distance - to) > 0) continue;
    return force[i - 1] + (distance - from) / (to - from) * (force[i] - force[i - 1]);
  }
  return NAN;
}

// Vertical bars between what two records of the same way measured.
render::Series repeat_bars(const ComparedLoops& compared, const ComparedLoops& repeat, int cycle) {
  render::Series bars{"measured, up to down", {}, {}, Style::line, kMeasuredColor, 4};
  const BranchForces one = compared.measured_forces(), other = repeat.measured_forces();
  for (int b = 2 * cycle; b <= 2 * cycle + 1; ++b)
    for (std::size_t i = 0; i < one[b].size(); ++i) {
      const double at = compared.loops.branches[b].distance[i],
                   beside = force_at(repeat.loops.branches[b], other[b], at);
      if (!std::isfinite(beside)) continue;
      for (const double force : {one[b][i], beside, std::numeric_limits<double>::quiet_NaN()})
        bars.add(kMillimetre * at, force);
    }
  return bars;
}

render::PagePlot cycle_panel(const std::string& kind, double noise, const ComparedLoops& compared,
                             const ComparedLoops* repeat, int cycle) {
  const BranchForces measured = compared.measured_forces();
  const double area =
      loop_area(compared.loops, compared.run.force, cycle) / loop_area(compared.loops, measured, cycle);
  const auto out = static_cast<std::size_t>(2 * cycle);  // the cycle's first branch; the second leads back
  const double rms = rms_difference(compared.run.force, measured, out, out + 2);
  render::Plot plot{
      fmt::format("{}: area {:+.0f} %, rms {:.1f} of the noise", kind, 100 * (area - 1), rms / noise),
      {"distance of the clamps [mm]"},
      {"force per width [N/m]"}};
  render::Series data = cycle_series(compared.loops, measured, cycle, Style::points);
  data.label = "measured", data.color = kMeasuredColor;
  if (repeat) data = repeat_bars(compared, *repeat, cycle);
  render::Series model = cycle_series(compared.loops, compared.run.force, cycle, Style::line);
  model.label = "simulated", model.color = kSimulatedColor;
  plot.series = {data, model};
  return {plot, cycle == 0 ? "center center" : "off"};
}

}  // namespace

void draw_cycles(Run& run, const std::string& name, const std::string& title,
                 const std::vector<std::string>& kinds, double noise, const ComparedLoops& compared,
                 const ComparedLoops* repeat) {
  render::PlotPage page{title, "force against distance of the clamps, tension > 0", {}};
  page.columns = 1;
  page.plot_width = 640;
  page.plot_height = 300;
  for (int cycle = 0; cycle < compared.loops.cycles(); ++cycle)
    page.plots.push_back(cycle_panel("cycle " + std::to_string(cycle + 1) + ", " + kinds[cycle], noise,
                                     compared, repeat, cycle));
  run.plot(name, page, render::write_plot_page);
}

void draw_shapes(Run& run, const std::string& name, const std::string& title, const ComparedLoops& compared) {
  if (compared.run.shapes.empty()) return;
  render::Plot plot{title, {"along the line of the clamps [mm]"}, {"height [mm]"}};
  plot.equal_scales = true;
  const double up = compared.loops.bends_up() ? 1 : -1;
  for (std::size_t i = 0; i < compared.run.shapes.size(); ++i) {
    const bool back = i > 0 && i % 2 == 0;
    render::Series series{.label = i == 0 ? "laid" : "", .x = {}, .y = {}};
    if (i > 0) series.label = "cycle " + std::to_string((i + 1) / 2) + (back ? ", back" : ", out");
    series.style = back ? Style::dashed : Style::line;
    if (i > 0) series.color = cycle_color(static_cast<int>(i - 1) / 2);
    add_line(compared.run.shapes[i], up, series);
    plot.series.push_back(series);
  }
  run.plot(name, plot);
}

}  // namespace hysteron::experiments
