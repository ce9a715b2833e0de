#include "experiments/stability/output.h"

#include <fmt/core.h>

#include <algorithm>
#include <map>

#include "sim/base/csv.h"
#include "sim/scene/scene_reader.h"

namespace hysteron::experiments {
namespace {

using Counts = std::map<Outcome, int>;

Counts count(const std::vector<Cell>& cells, const std::string& integrator) {
  Counts counts;
  for (const Cell& cell : cells)
    if (integrator.empty() || cell.integrator == integrator) ++counts[cell.finding.outcome];
  return counts;
}

std::vector<std::string> integrators_in(const std::vector<Cell>& cells) {
  std::vector<std::string> names;
  for (const Cell& cell : cells)
    if (!std::count(names.begin(), names.end(), cell.integrator)) names.push_back(cell.integrator);
  return names;
}

}  // namespace

void write_cells(Run& run, const std::vector<Sweep>& sweeps, const std::vector<Cell>& cells) {
  Table table(
      "sweep,integrator,variant,x,y,law,element,precision,step [s],outcome,energy growth,"
      "ledger remainder,largest stretch,seconds asked [s],seconds simulated [s],steps,substeps per step,"
      "retried steps,wall [s],message");
  for (const Cell& cell : cells) {
    const Sweep& sweep = sweeps[cell.sweep];
    const Scene& scene = cell.attempt.scene;
    const Finding& f = cell.finding;
    const bool ran = f.outcome != Outcome::refused;
    const auto if_ran = [&](const hysteron::Cell& field) { return ran ? field : hysteron::Cell(""); };
    table.row({sweep.name,
               cell.integrator,
               sweep.variants[cell.variant],
               sweep.x.ticks[cell.column],
               sweep.y.ticks[cell.row],
               scene.law,
               name_of(scene.element),
               name_of(scene.precision),
               scene.step,
               name_of(f.outcome),
               if_ran(f.energy_growth),
               if_ran(f.remainder),
               if_ran(f.largest_stretch),
               f.seconds_asked,
               if_ran(f.seconds_simulated),
               if_ran(f.steps),
               if_ran(f.substeps),
               if_ran(f.retried_steps),
               f.wall_seconds,
               f.message});
  }
  table.write(run.path("cells.csv"));
}

void write_counts(Run& run, const std::vector<Cell>& cells) {
  std::vector<std::string> integrators = integrators_in(cells);
  integrators.insert(integrators.begin(), "");
  for (const std::string& integrator : integrators) {
    const std::string prefix = integrator.empty() ? "" : integrator + ".";
    Counts counts = count(cells, integrator);
    int all = 0;
    for (const auto& [outcome, n] : counts) all += n;
    run.metric(prefix + "cells", all);
    for (Outcome outcome : kOutcomes) run.metric(prefix + name_of(outcome), counts[outcome]);
  }
  run.metric("diverged_default", count(cells, name_of(default_scene().integrator))[Outcome::diverged]);
}

void print_counts(const std::vector<Cell>& cells) {
  fmt::print("{:<14}", "integrator");
  for (Outcome outcome : kOutcomes) fmt::print(" {:>9}", name_of(outcome));
  for (const std::string& integrator : integrators_in(cells)) {
    fmt::print("\n{:<14}", integrator);
    Counts counts = count(cells, integrator);
    for (Outcome outcome : kOutcomes) fmt::print(" {:9}", counts[outcome]);
  }
  fmt::print("\n");
}

void write_limits(Run& run, const std::vector<MeasuredLimit>& limits) {
  Table table(
      "mesh,element,edge,law,damping [s],largest amplitude [m],bound [s],measured [s],measured/bound");
  double least = kMaxRatio, most = 0, least_resonant = kMaxRatio;
  for (const MeasuredLimit& limit : limits) {
    const LimitCase& of = limit.of;
    table.row({of.mesh, name_of(of.element), of.held ? "held" : "free", of.condition.law,
               of.condition.damping, of.condition.amplitudes.back(), limit.bound, limit.measured,
               limit.ratio()});
    if (of.condition.resonates() && of.condition.damping == 0) {
      least_resonant = std::min(least_resonant, limit.ratio());
      continue;
    }
    least = std::min(least, limit.ratio()), most = std::max(most, limit.ratio());
  }
  table.write(run.path("limit.csv"));
  run.metric("limit_smallest_ratio", least);
  run.metric("limit_largest_ratio", most);
  if (least_resonant < kMaxRatio) run.metric("undamped_resonance_smallest_ratio", least_resonant);
}

}  // namespace hysteron::experiments
