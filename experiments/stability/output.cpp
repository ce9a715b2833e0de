#include "experiments/stability/output.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>

#include "sim/base/atomic_file.h"
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
  AtomicFile file(run.path("cells.csv").string());
  file.stream()
      << "sweep,integrator,variant,x,y,law,element,precision,step [s],outcome,energy growth,"
         "ledger remainder,largest stretch,seconds asked [s],seconds simulated [s],steps,substeps per step,"
         "retried steps,wall [s],message\n";
  for (const Cell& cell : cells) {
    const Sweep& sweep = sweeps[cell.sweep];
    const Scene& scene = cell.attempt.scene;
    const Finding& f = cell.finding;
    const bool ran = f.outcome != Outcome::refused;
    const auto if_ran = [&](const std::string& text) { return ran ? text : std::string(); };
    file.stream() << row_of({sweep.name,
                             cell.integrator,
                             sweep.variants[cell.variant],
                             sweep.x.ticks[cell.column],
                             sweep.y.ticks[cell.row],
                             scene.law,
                             name_of(scene.element),
                             name_of(scene.precision),
                             number_field(scene.step),
                             name_of(f.outcome),
                             if_ran(number_field(f.energy_growth)),
                             if_ran(number_field(f.remainder)),
                             if_ran(number_field(f.largest_stretch)),
                             number_field(f.seconds_asked),
                             if_ran(number_field(f.seconds_simulated)),
                             if_ran(std::to_string(f.steps)),
                             if_ran(std::to_string(f.substeps)),
                             if_ran(std::to_string(f.retried_steps)),
                             number_field(f.wall_seconds),
                             f.message});
  }
  file.commit();
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

void print_counts(const std::vector<Sweep>& sweeps, const std::vector<Cell>& cells) {
  std::printf("%-14s", "integrator");
  for (Outcome outcome : kOutcomes) std::printf(" %9s", name_of(outcome));
  for (const std::string& integrator : integrators_in(cells)) {
    std::printf("\n%-14s", integrator.c_str());
    Counts counts = count(cells, integrator);
    for (Outcome outcome : kOutcomes) std::printf(" %9d", counts[outcome]);
  }
  std::printf("\n");
  for (const Cell& cell : cells) {
    if (cell.finding.outcome != Outcome::diverged) continue;
    const Sweep& sweep = sweeps[cell.sweep];
    std::printf("diverged: %s, %s, %s, %s, %s: %s (growth %.3g)\n", sweep.name.c_str(),
                cell.integrator.c_str(), sweep.variants[cell.variant].c_str(),
                sweep.x.ticks[cell.column].c_str(), sweep.y.ticks[cell.row].c_str(),
                cell.finding.message.c_str(), cell.finding.energy_growth);
  }
}

void write_limits(Run& run, const std::vector<MeasuredLimit>& limits) {
  AtomicFile file(run.path("limit.csv").string());
  file.stream()
      << "mesh,element,edge,law,damping [s],largest amplitude [m],bound [s],measured [s],measured/bound\n";
  double least = kMostRatio, most = 0, least_resonant = kMostRatio;
  for (const MeasuredLimit& limit : limits) {
    const LimitCase& of = limit.of;
    file.stream() << row_of({of.mesh, name_of(of.element), of.held ? "held" : "free", of.condition.law,
                             number_field(of.condition.damping), number_field(of.condition.amplitudes.back()),
                             number_field(limit.bound), number_field(limit.measured),
                             number_field(limit.ratio())});
    if (of.condition.resonates() && of.condition.damping == 0) {
      least_resonant = std::min(least_resonant, limit.ratio());
      continue;
    }
    least = std::min(least, limit.ratio()), most = std::max(most, limit.ratio());
  }
  file.commit();
  run.metric("limit_smallest_ratio", least);
  run.metric("limit_largest_ratio", most);
  if (least_resonant < kMostRatio) run.metric("undamped_resonance_smallest_ratio", least_resonant);
}

void print_limits(const std::vector<MeasuredLimit>& limits) {
  std::printf("measured limit of the explicit bending step over the bound in use:\n");
  for (const MeasuredLimit& limit : limits) {
    const LimitCase& of = limit.of;
    std::printf("%-11s %-5s %-4s %-8s damping %-6g s  amplitude %-6g m  %.3g / %.3g s = %.3f\n",
                of.mesh.c_str(), name_of(of.element).c_str(), of.held ? "held" : "free",
                of.condition.law.c_str(), of.condition.damping, of.condition.amplitudes.back(),
                limit.measured, limit.bound, limit.ratio());
  }
}

}  // namespace hysteron::experiments
