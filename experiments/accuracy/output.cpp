#include "experiments/accuracy/output.h"

#include <fmt/core.h>

#include <algorithm>

#include "render/plot.h"
#include "sim/base/csv.h"

namespace hysteron::experiments {
namespace {

// What is not finite is said, not left out.
std::string number(double value) { return fmt::format("{:.6g}", value); }

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
                 s.mesh,
                 name_of(s.element),
                 s.law,
                 number(s.load),
                 name_of(s.integrator),
                 name_of(s.implicit_every),
                 number(s.step),
                 number(s.tolerance),
                 name_of(s.precision),
                 name_of(s.device),
                 number(f.triangles),
                 number(f.value),
                 number(f.reference),
                 number(f.error),
                 number(f.uncertainty),
                 f.steps,
                 number(f.seconds),
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
      table.row({solution.problem.name, o.in, o.group, number(o.from), number(o.to), number(o.error_from),
                 number(o.error_to), number(o.order)});
  table.write(run.path("orders.csv"));
}

// Cell of the table: what it takes.
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

// Errors below this are at the end of the digits; on a logarithmic scale they would stretch it.
constexpr double kMinDrawn = 1e-6;

render::Plot plot_of(const Solution& solution) {
  render::Plot plot{solution.problem.title, {"computing [s]", true}, {solution.problem.error, true}};
  for (const auto& [setting, found] : solution.solved) {
    if (!found.failed.empty() || !solution.comparable(setting)) continue;
    const std::string label = series_of(solution, setting);
    auto at = std::find_if(plot.series.begin(), plot.series.end(),
                           [&](const render::Series& s) { return s.label == label; });
    if (at == plot.series.end())
      at = plot.series.insert(plot.series.end(), {label, {}, {}, render::Series::Style::points});
    at->x.push_back(found.seconds);
    at->y.push_back(std::max(found.error, kMinDrawn));
  }
  render::Series front{"front", {}, {}, render::Series::Style::dashed, "#222222"};
  for (std::size_t i : pareto_front(solution)) {
    front.x.push_back(solution.solved[i].found.seconds);
    front.y.push_back(std::max(solution.solved[i].found.error, kMinDrawn));
  }
  plot.series.push_back(front);
  return plot;
}

}  // namespace

void write_accuracy(Run& run, const std::vector<Solution>& solutions) {
  write_table(run, solutions);
  write_orders(run, solutions);
  write_cheapest(run, solutions);
}

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

void draw_accuracy(Run& run, const std::vector<Solution>& solutions) {
  for (const Solution& solution : solutions) {
    const render::Plot plot = plot_of(solution);
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

}  // namespace hysteron::experiments
