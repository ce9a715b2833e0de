// `hysteron accuracy` measures error against run time, for problems that have independent references.
#include <fmt/core.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "experiments/accuracy/accuracy.h"
#include "experiments/workbench/app/experiment.h"
#include "experiments/workbench/app/key_conditions.h"
#include "experiments/workbench/pages/report.h"
#include "render/plot.h"
#include "sim/base/comma_list.h"
#include "sim/base/csv.h"
#include "sim/base/error.h"
#include "sim/base/number_in.h"
#include "sim/scene/choice.h"

namespace hysteron::experiments {

Scene with(const MethodSetting& setting, Scene scene) {
  scene.mesh = enum_name(setting.mesh);
  scene.element = setting.element;
  scene.law = setting.law;
  scene.integrator = setting.integrator;
  scene.implicit_every = setting.implicit_every;
  scene.force = setting.force;
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
  std::string problem = "all";
  NamedDevice device = NamedDevice::cpu;
  Options options;
};

using F = AccuracyFlags;
// clang-format off
const KeyRow<F> kRows[] = {
    {"problem", at<&F::problem>, "", any(), "bend, sag, droop, buckle, decay, swing, crease; several separated by commas, or all"},
    {"device", at<&F::device>, "", any(), "where settings are computed, one after the other; on the cpu by one thread"},
};
// clang-format on

Keys option_keys(F& flags) { return with_output_options(bind(kRows, flags), flags.options); }

std::vector<Problem> chosen_problems(const F& flags) {
  const Effort effort{flags.options.quick, device_choice(flags.device)};
  std::vector<Problem> all;
  for (const auto& make : {bend_problem, sag_problem, droop_problem, buckle_problem, decay_problem,
                           swing_problem, crease_problem})
    all.push_back(make(effort));
  if (flags.problem == "all") return all;
  std::vector<Problem> chosen;
  for (const std::string& name : listed_names("problem", flags.problem)) {
    const auto found =
        std::find_if(all.begin(), all.end(), [&](const Problem& problem) { return problem.name == name; });
    if (found == all.end()) {
      std::vector<std::string> known;
      for (const Problem& problem : all) known.push_back(problem.name);
      throw not_a_choice("problem", name, known).with_experiment("accuracy");
    }
    chosen.push_back(*found);
  }
  return chosen;
}

// Solves the problem with a setting.  A setting that cannot be solved is a result too; a failing machine is
// not.
Found tried(const Problem& problem, const MethodSetting& setting) {
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
  for (const MethodSetting& setting : problem.settings) {
    const Found found = tried(problem, setting);
    solution.solved.push_back({setting, found});
    run.progress(fmt::format("{}, {}: {}", problem.name, describe(solution, setting),
                             found.failed.empty()
                                 ? fmt::format("error {:.3g}, {:.3g} s", found.error, found.seconds)
                                 : found.failed));
  }
  return solution;
}

constexpr double kTargets[] = {0.1, 0.03, 0.01, 0.003};

// Formats a number for the table; values that are not finite are printed as such, not left out.

void write_table(Run& run, const std::vector<Solution>& solutions) {
  Table table(
      "problem,factor,setting,mesh,element,law,load,integrator,implicit every,step [s],tolerance,"
      "precision,device,triangles,value,reference,error,reference uncertainty,steps,computing [s],"
      "memory [byte],on front,failed");
  for (const Solution& solution : solutions) {
    const auto front = pareto_front(solution);
    for (std::size_t i = 0; i < solution.solved.size(); ++i) {
      const auto& [s, f] = solution.solved[i];
      const bool on_front = std::find(front.begin(), front.end(), i) != front.end();
      table.row({solution.problem.name,
                 s.factor,
                 describe(solution, s),
                 enum_name(s.mesh),
                 enum_name(s.element),
                 s.law,
                 number_text(s.load, 6),
                 enum_name(s.integrator),
                 enum_name(s.implicit_every),
                 number_text(s.step, 6),
                 number_text(s.tolerance, 6),
                 enum_name(s.precision),
                 enum_name(s.device),
                 number_text(f.triangles, 6),
                 number_text(f.value, 6),
                 number_text(f.reference, 6),
                 number_text(f.error, 6),
                 number_text(f.uncertainty, 6),
                 f.steps,
                 number_text(f.seconds, 6),
                 f.bytes,
                 on_front ? "yes" : "no",
                 f.failed});
    }
  }
  table.write(run.path("table.csv"));
}

void write_orders(Run& run, const std::vector<Solution>& solutions) {
  Table table("problem,in,group,from,to,error from,error to,order");
  for (const Solution& solution : solutions)
    for (const Order& o : observed_orders(solution))
      table.row({solution.problem.name, o.in, o.group, number_text(o.from, 6), number_text(o.to, 6),
                 number_text(o.error_from, 6), number_text(o.error_to, 6), number_text(o.order, 6)});
  table.write(run.path("orders.csv"));
}

// Returns the table's cell that names the cheapest setting and its time [s].
std::string cheapest_text(const Solution& solution, double target) {
  const auto best = cheapest(solution, target);
  if (!best) return "none";
  const Solved& solved = solution.solved[*best];
  return fmt::format("{}: {:.2g} s", describe(solution, solved.setting), solved.found.seconds);
}

void write_cheapest(Run& run, const std::vector<Solution>& solutions) {
  Table table("problem,10 %,3 %,1 %,0.3 %");
  for (const Solution& solution : solutions) {
    std::vector<Cell> row = {solution.problem.name};
    for (double target : kTargets) row.push_back(cheapest_text(solution, target));
    table.row(row);
  }
  table.write(run.path("cheapest.csv"));
}

// Errors below this are rounding; they would only stretch a logarithmic axis, so they are not drawn.
constexpr double kMinDrawn = 1e-6;

render::Plot solution_plot(const Solution& solution) {
  render::Plot plot{solution.problem.title, {"computing [s]", true}, {solution.problem.error, true}};
  for (const auto& [setting, found] : solution.solved) {
    if (!found.failed.empty() || !solution.comparable(setting)) continue;
    const std::string label = curve_label(solution, setting);
    auto at = std::find_if(plot.series.begin(), plot.series.end(),
                           [&](const render::Series& s) { return s.label == label; });
    if (at == plot.series.end())
      at = plot.series.insert(plot.series.end(), {label, {}, {}, render::Series::Style::points});
    at->add(found.seconds, std::max(found.error, kMinDrawn));
  }
  render::Series front{"front", {}, {}, render::Series::Style::dashed, "#222222"};
  for (std::size_t i : pareto_front(solution)) {
    front.add(solution.solved[i].found.seconds, std::max(solution.solved[i].found.error, kMinDrawn));
  }
  plot.series.push_back(front);
  return plot;
}

// Writes table.csv with a setting per row, orders.csv, and cheapest.csv with what reaches kTargets in the
// least time.
void write_accuracy(Run& run, const std::vector<Solution>& solutions) {
  write_table(run, solutions);
  write_orders(run, solutions);
  write_cheapest(run, solutions);
}

// Writes the metrics PROBLEM.base_error_percent, PROBLEM.settings_count, PROBLEM.front_count and so on.
void write_accuracy_metrics(Run& run, const std::vector<Solution>& solutions) {
  for (const Solution& solution : solutions) {
    const std::string& name = solution.problem.name;
    const Found& base = solution.solved.front().found;
    if (base.failed.empty()) run.metric(name + ".base_error_percent", 100 * base.error);
    run.metric(name + ".settings_count", solution.solved.size());
    run.metric(name + ".failed_count",
               std::count_if(solution.solved.begin(), solution.solved.end(),
                             [](const Solved& s) { return !s.found.failed.empty(); }));
    run.metric(name + ".front_count", pareto_front(solution).size());
    double seconds = 0;
    for (const Solved& s : solution.solved) seconds += s.found.seconds;
    run.metric(name + ".computing_s", seconds);
  }
}

// Draws plot_PROBLEM: error against seconds, with the Pareto front marked.
void draw_accuracy(Run& run, const std::vector<Solution>& solutions) {
  for (const Solution& solution : solutions) {
    const render::Plot plot = solution_plot(solution);
    if (plot.series.back().x.empty()) continue;
    run.plot("plot_" + solution.problem.name, plot);
  }
}

void print_accuracy(const std::vector<Solution>& solutions) {
  for (const Solution& solution : solutions) {
    fmt::print("\n{}: {}\nerror: {}; reference: {}\n", solution.problem.name, solution.problem.title,
               solution.problem.error, solution.problem.reference);
    for (double target : kTargets)
      fmt::print("cheapest within {:4.1f} %: {}\n", 100 * target, cheapest_text(solution, target));
  }
}

int run_accuracy(const CommandLine& line) {
  F flags;
  set_keys(line, option_keys(flags));
  const std::vector<Problem> problems = chosen_problems(flags);
  Run run(line, flags.options, to_json(bind(kRows, flags)));
  run.reserve({"table.csv", "orders.csv", "cheapest.csv"});
  std::vector<Solution> solutions;
  for (const Problem& problem : problems) {
    solutions.push_back(solved(problem, run));
    write_accuracy(run, solutions);  // so that an interrupted run keeps what it has found
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
      .own_keys = own_key_descriptions<option_keys>};
}

}  // namespace hysteron::experiments
