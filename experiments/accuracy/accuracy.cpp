// `hysteron accuracy`: error against run time, for problems with references of their own.
#include <fmt/core.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "experiments/accuracy/output.h"
#include "experiments/workbench/app/experiment.h"
#include "experiments/workbench/pages/report.h"
#include "sim/base/comma_list.h"
#include "sim/base/error.h"

namespace hysteron::experiments {

Scene with(const Setting& setting, Scene scene) {
  scene.mesh = setting.mesh;
  scene.element = setting.element;
  scene.law = setting.law;
  scene.integrator = setting.integrator;
  scene.implicit_every = setting.implicit_every;
  scene.precision = setting.precision;
  scene.device = setting.device;
  scene.threads = 1;
  scene.substeps = 0;
  if (setting.triangles > 0) scene.triangles = setting.triangles;
  if (setting.step > 0) scene.step = setting.step;
  (setting.integrator == Integrator::quasi_static ? scene.newton_residual : scene.tolerance) =
      setting.tolerance;
  if (scene.newton_residual == 0) scene.newton_residual = Scene{}.newton_residual;
  return scene;
}

void note_cost(Simulation& simulation, const Scene& scene, std::chrono::steady_clock::time_point start,
               Found& found) {
  found.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  const long parts = simulation.counts().parts;
  found.steps = parts > 0             ? parts
                : scene.is_implicit() ? simulation.steps()
                                      : simulation.steps() * simulation.limits().substeps;
  found.bytes = simulation.counts().bytes;
}

namespace {

struct AccuracyFlags {
  std::string problem = "all", device = "cpu";
  Options options;
};

using F = AccuracyFlags;
// clang-format off
const KeyRow<F> kRows[] = {
    {"problem", at<&F::problem>, "", any(), "", "bend, sag, droop, buckle, decay, swing, crease; several separated by commas, or all"},
    {"device", at<&F::device>, "", any(), "cpu | cuda", "where settings are computed, one after the other; on the cpu by one thread"},
};
// clang-format on

Keys keys_of(F& flags) { return with_output_options(bind(kRows, flags), flags.options); }

std::vector<Problem> problems_of(const F& flags) {
  const Effort effort{flags.options.quick, value_named<DeviceChoice>(flags.device)};
  std::vector<Problem> all;
  for (const auto& make : {bend_problem, sag_problem, droop_problem, buckle_problem, decay_problem,
                           swing_problem, crease_problem})
    all.push_back(make(effort));
  if (flags.problem == "all") return all;
  std::vector<Problem> chosen;
  for (const std::string& name : split(flags.problem)) {
    const auto found =
        std::find_if(all.begin(), all.end(), [&](const Problem& problem) { return problem.name == name; });
    if (found == all.end()) {
      std::string known;
      for (const Problem& problem : all) known += (known.empty() ? "" : ", ") + problem.name;
      throw Error::invalid_input("problem = " + name + " is not one of: " + known)
          .of("problem", name)
          .in("accuracy");
    }
    chosen.push_back(*found);
  }
  return chosen;
}

// Settings that cannot be solved are findings too; a machine that fails is not.
Found tried(const Problem& problem, const Setting& setting) {
  try {
    return problem.solve(setting);
  } catch (const Error& error) {
    if (error.exit_code() == 1) throw;
    Found found;
    found.failed = error.what();
    return found;
  }
}

Solution solved(const Problem& problem, Run& run) {
  Solution solution{problem, {}};
  for (const Setting& setting : problem.settings) {
    const Found found = tried(problem, setting);
    solution.solved.push_back({setting, found});
    run.progress(fmt::format("{}, {}: {}", problem.name, describe(solution, setting),
                             found.failed.empty()
                                 ? fmt::format("error {:.3g}, {:.3g} s", found.error, found.seconds)
                                 : found.failed));
  }
  return solution;
}

int run_accuracy(const CommandLine& line) {
  F flags;
  set_keys(line, keys_of(flags));
  const std::vector<Problem> problems = problems_of(flags);
  Run run(line, flags.options, to_json(bind(kRows, flags)));
  run.reserve({"table.csv", "orders.csv", "cheapest.csv"});
  std::vector<Solution> solutions;
  for (const Problem& problem : problems) {
    solutions.push_back(solved(problem, run));
    write_accuracy(run, solutions);  // a run that is cut short keeps what it has found
  }
  write_accuracy_metrics(run, solutions);
  if (!flags.options.no_images) draw_accuracy(run, solutions);
  finish_with_report(run);
  if (!flags.options.json) print_accuracy(solutions);
  return 0;
}

}  // namespace

Experiment accuracy() {
  return {
      .name = "accuracy",
      .question = "error against run time, against references of their own; orders; the cheapest settings",
      .run = run_accuracy,
      .own_keys = own_keys_of<keys_of>};
}

}  // namespace hysteron::experiments
