#include "experiments/fab/sheet_output.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "render/plot.h"

namespace hysteron::experiments {
namespace {

// Recorded clamps may turn within a branch, and friction remembers where.
bool turns_at(const std::vector<double>& distance, std::size_t i) {
  return (distance[i] - distance[i - 1]) * (distance[i + 1] - distance[i]) < 0;
}

// Every second of the values at a branch's distances, its end and the turns within.
std::vector<double> every_second(const std::vector<double>& values, const std::vector<double>& distance) {
  std::vector<double> kept;
  for (std::size_t i = 0; i < values.size(); ++i)
    if (i % 2 == 0 || i + 1 == values.size() || turns_at(distance, i)) kept.push_back(values[i]);
  return kept;
}

BranchForces every_second(const BranchForces& force, const FabLoops& loops) {
  BranchForces kept;
  for (std::size_t b = 0; b < force.size(); ++b)
    kept.push_back(every_second(force[b], loops.branches[b].distance));
  return kept;
}

FabLoops every_second(FabLoops loops) {
  for (FabBranch& branch : loops.branches)
    branch = {every_second(branch.distance, branch.distance), every_second(branch.force, branch.distance)};
  return loops;
}

double largest(const BranchForces& force) {
  double most = 0;
  for (const auto& branch : force)
    for (const double f : branch) most = std::max(most, std::abs(f));
  return most;
}

BranchForces difference(const BranchForces& a, const BranchForces& b) {
  BranchForces result = a;
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t k = 0; k < a[i].size(); ++k) result[i][k] -= b[i][k];
  return result;
}

// A reading of the sheet beside the elastica's, and what it changes by with the repeats.
struct Verified {
  CycleReading strip;
  double sheet, mesh_error, step_error;
  double percent(double of) const { return 100 * of / std::abs(strip.value); }
  double difference_percent() const { return percent(sheet - strip.value); }
};

// Of a cycle without friction the area is what rounding leaves of it: no number to be compared with.
bool is_rounding(const CycleReading& reading, const FabLoops& loops, const BranchForces& force) {
  constexpr double kRounding = 1e-6;  // relative
  return std::abs(reading.value) < kRounding * loops.gauge * largest(force);
}

std::vector<Verified> verified(const ComparedLoops& compared, const SheetRepeats& repeats, int cycle) {
  const FabLoops &all = compared.loops, &some = repeats.every_other;
  const auto strip = readings(all, compared.run.force, cycle);
  const auto sheet = readings(all, compared.sheet->force, cycle);
  const auto coarse = readings(all, repeats.coarse.force, cycle);
  const auto near = readings(some, every_second(repeats.coarse.force, all), cycle);
  const auto far_apart = readings(some, repeats.far_apart.force, cycle);
  std::vector<Verified> result;
  for (std::size_t i = 0; i < strip.size(); ++i)
    if (!is_rounding(strip[i], all, compared.run.force))
      result.push_back({strip[i], sheet[i].value, std::abs(sheet[i].value - coarse[i].value),
                        std::abs(near[i].value - far_apart[i].value)});
  return result;
}

}  // namespace

SheetRepeats repeated(const FabLoops& loops, const Fabric& fabric, SheetShape shape) {
  shape.triangles /= 4;
  const FabLoops every_other = every_second(loops);
  return {test_sheet(fab_sheet(loops, fabric, shape), loops),
          test_sheet(fab_sheet(every_other, fabric, shape), every_other), every_other};
}

void add_sheet_metrics(Run& run, const ComparedLoops& compared, const SheetRepeats& repeats) {
  for (int cycle = 0; cycle < compared.loops.cycles(); ++cycle)
    for (const Verified& v : verified(compared, repeats, cycle)) {
      const std::string name = "sheet_" + v.strip.name;
      run.metric(name + "_difference_percent", v.difference_percent());
      run.metric(name + "_mesh_error", v.mesh_error);
      run.metric(name + "_step_error", v.step_error);
    }
  const SheetRun& sheet = *compared.sheet;
  run.metric("sheet_largest_force_difference_percent",
             100 * largest(difference(sheet.force, compared.run.force)) / largest(compared.run.force));
  run.metric("sheet_work_J_per_m", sheet.work);
  run.metric("sheet_dissipated_J_per_m", sheet.dissipated);
  run.metric("sheet_triangles_count", sheet.triangles);
  run.metric("sheet_newton_iterations_per_step", sheet.newton_iterations);
  run.metric("sheet_retried_steps_count", sheet.retried_steps);
  run.metric("sheet_solve_s", sheet.seconds);
  run.manifest().triangles = sheet.triangles;
  run.manifest().state_hash = fmt::format("{:016x}", sheet.state_hash);
}

void draw_difference(Run& run, const std::string& title, const ComparedLoops& compared) {
  render::Plot plot{"Sheet less elastica, " + title,
                    {"distance of the clamps [mm]"},
                    {"difference of force, of the largest [%]"}};
  const BranchForces apart = difference(compared.sheet->force, compared.run.force);
  const double scale = 100 / largest(compared.run.force);
  for (int cycle = 0; cycle < compared.loops.cycles(); ++cycle) {
    render::Series series = series_of(compared.loops, apart, cycle, render::Series::Style::line);
    for (double& y : series.y) y *= scale;
    series.label = "cycle " + std::to_string(cycle + 1);
    plot.series.push_back(series);
  }
  run.plot("plot_difference", plot);
}

void print_sheet(const ComparedLoops& compared, const SheetRepeats& repeats) {
  for (int cycle = 0; cycle < compared.loops.cycles(); ++cycle) {
    std::string line = fmt::format("sheet, cycle {}:", cycle + 1);
    for (const Verified& v : verified(compared, repeats, cycle))
      line += fmt::format(" {} {:+.2f} % (mesh {:.2f}, step {:.3f}),", v.strip.what, v.difference_percent(),
                          v.percent(v.mesh_error), v.percent(v.step_error));
    fmt::print("  {}\n", line.substr(0, line.size() - 1));
  }
}

}  // namespace hysteron::experiments
