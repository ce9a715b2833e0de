// `hysteron stability`: maps of what stays stable, and the explicit limit against the bound in use.
#include <algorithm>
#include <nlohmann/json.hpp>
#include <thread>

#include "experiments/stability/output.h"
#include "experiments/workbench/app/experiment.h"
#include "experiments/workbench/app/run.h"
#include "experiments/workbench/pages/report.h"
#include "sim/base/comma_list.h"

namespace hysteron::experiments {
namespace {

constexpr const char* kLimitSweep = "explicit-limit";

struct StabilityFlags {
  std::string device = "cpu";
  std::string integrator = "all", law, sweep = "all";
  CellEffort effort;
  double threads = 0, limit_steps = 2000;
  Options options;
};

using F = StabilityFlags;
// clang-format off
const KeyRow<F> kRows[] = {
    {"device", at<&F::device>, "", any(), "cpu | cuda", "where cells are simulated"},
    {"integrator", at<&F::integrator>, "", any(), "", "NAME, several separated by commas, or all"},
    {"law", at<&F::law>, "", any(), "", "of all sweeps; default: linear, prandtl and wong in maps, all in scenes"},
    {"sweep", at<&F::sweep>, "", any(), "", "NAME, several separated by commas, or all"},
    {"seconds", at<&F::effort, &CellEffort::seconds>, "s", positive(), "", "simulated time of a cell"},
    {"work", at<&F::effort, &CellEffort::work>, "", positive(), "", "explicit substeps after which a cell's time is cut short; a step of implicit or bdf2 counts 20"},
    {"limit-steps", at<&F::limit_steps>, "", between(100, 1e7), "", "steps through which the energy must stay bounded (sweep explicit-limit)"},
    {"threads", at<&F::threads>, "", between(0, 1024), "", "of the host, a cell at a time each; 0: all cores, or 1 on cuda"},
};
// clang-format on
constexpr double kQuickWork = 300, kQuickLimitSteps = 600;

Keys keys_of(F& flags) { return with_output_options(bind(kRows, flags), flags.options); }

int threads_of(const F& flags) {
  if (flags.threads > 0) return static_cast<int>(flags.threads);
  return flags.device == "cuda" ? 1 : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

SweepChoice choice_of(const F& flags) {
  SweepChoice choice;
  if (flags.integrator != "all") choice.integrators = split(flags.integrator);
  choice.laws = split(flags.law);
  choice.device = value_named<DeviceChoice>(flags.device);
  choice.quick = flags.options.quick;
  return choice;
}

std::vector<Cell> tried(const F& flags, const std::vector<Sweep>& sweeps, Run& run) {
  std::vector<Cell> cells = cells_of(sweeps, choice_of(flags));
  const auto stage = run.stage("cells");
  const std::size_t every = std::max<std::size_t>(1, cells.size() / 20);
  try_all(cells, flags.effort, threads_of(flags), [&](std::size_t done) {
    if (done % every == 0)
      run.progress(std::to_string(done) + " of " + std::to_string(cells.size()) + " cells");
  });
  return cells;
}

int run_stability(const CommandLine& line) {
  F flags;
  set_keys(line, keys_of(flags), [&] {
    flags.effort.work = std::min(flags.effort.work, kQuickWork);
    flags.limit_steps = std::min(flags.limit_steps, kQuickLimitSteps);
  });
  std::vector<std::string> names = flags.sweep == "all" ? sweep_names() : split(flags.sweep);
  if (flags.sweep == "all") names.push_back(kLimitSweep);
  const bool with_limit = std::erase(names, kLimitSweep) > 0;
  const std::vector<Sweep> sweeps = make_sweeps(names, choice_of(flags));

  Run run(line, flags.options, to_json(bind(kRows, flags)));
  if (!sweeps.empty()) run.reserve({"cells.csv"});
  if (with_limit) run.reserve({"limit.csv"});
  if (!sweeps.empty()) {
    const std::vector<Cell> cells = tried(flags, sweeps, run);
    write_cells(run, sweeps, cells);
    write_counts(run, cells);
    if (!flags.options.no_images) draw_maps(run, sweeps, cells);
    if (!flags.options.json) print_counts(cells);
  }
  if (with_limit) {
    const std::vector<MeasuredLimit> limits = measure_limits(
        limit_cases(flags.options.quick), static_cast<int>(flags.limit_steps), threads_of(flags));
    write_limits(run, limits);
  }
  finish_with_report(run);
  return 0;
}

}  // namespace

Experiment stability() {
  return {.name = "stability",
          .question = "maps of what stays stable, over stiffness, step, mesh and extreme scenes",
          .run = run_stability,
          .own_keys = own_keys_of<keys_of>};
}

}  // namespace hysteron::experiments
