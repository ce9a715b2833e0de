#include "experiments/accuracy/output.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <tuple>
#include <utility>

#include "render/plot.h"
#include "sim/base/atomic_file.h"
#include "sim/base/csv.h"

namespace hysteron::experiments {
namespace {

std::string number(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.6g", value);
  return text;
}

void write_table(Run& run, const std::vector<Solution>& solutions) {
  AtomicFile file(run.path("table.csv").string());
  file.stream()
      << "problem,factor,setting,mesh,element,law,load,integrator,implicit every,step [s],tolerance,"
         "precision,device,triangles,value,reference,error,reference uncertainty,steps,computing [s],"
         "memory [byte],on front,failed\n";
  for (const Solution& solution : solutions) {
    const auto front = pareto_front(solution);
    for (std::size_t i = 0; i < solution.solved.size(); ++i) {
      const auto& [s, f] = solution.solved[i];
      const bool on_front = std::find(front.begin(), front.end(), i) != front.end();
      file.stream() << row_of({solution.problem.name,
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
                               std::to_string(f.steps),
                               number(f.seconds),
                               std::to_string(f.bytes),
                               on_front ? "yes" : "no",
                               f.failed});
    }
  }
  file.commit();
}

void write_orders(Run& run, const std::vector<Solution>& solutions) {
  AtomicFile file(run.path("orders.csv").string());
  file.stream() << "problem,in,group,from,to,error from,error to,order\n";
  for (const Solution& solution : solutions)
    for (const Order& o : observed_orders(solution))
      file.stream() << row_of({solution.problem.name, o.in, o.group, number(o.from), number(o.to),
                               number(o.error_from), number(o.error_to), number(o.order)});
  file.commit();
}

// Cell of the table: what it takes.
std::string cheapest_text(const Solution& solution, double target) {
  const auto best = cheapest(solution, target);
  if (!best) return "none";
  const Solved& solved = solution.solved[*best];
  char text[40];
  std::snprintf(text, sizeof text, ": %.2g s", solved.found.seconds);
  return describe(solution, solved.setting) + text;
}

void write_cheapest(Run& run, const std::vector<Solution>& solutions) {
  AtomicFile file(run.path("cheapest.csv").string());
  file.stream() << "problem,10 %,3 %,1 %,0.3 %\n";
  for (const Solution& solution : solutions) {
    std::vector<std::string> row = {solution.problem.name};
    for (double target : kTargets) row.push_back(cheapest_text(solution, target));
    file.stream() << row_of(row);
  }
  file.commit();
}

// Errors below this are at the end of the digits; on a logarithmic scale they would stretch it.
constexpr double kLeastDrawn = 1e-6;

void sort_by_time(render::Series& series) {
  std::vector<std::pair<double, double>> points;
  for (std::size_t i = 0; i < series.x.size(); ++i) points.emplace_back(series.x[i], series.y[i]);
  std::sort(points.begin(), points.end());
  for (std::size_t i = 0; i < points.size(); ++i) std::tie(series.x[i], series.y[i]) = points[i];
}

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
    at->y.push_back(std::max(found.error, kLeastDrawn));
  }
  for (render::Series& series : plot.series) sort_by_time(series);
  render::Series front{"front", {}, {}, render::Series::Style::dashed, "#222222"};
  for (std::size_t i : pareto_front(solution)) {
    front.x.push_back(solution.solved[i].found.seconds);
    front.y.push_back(std::max(solution.solved[i].found.error, kLeastDrawn));
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
    run.plot("plot_" + solution.problem.name, [&](const auto& base) { render::write_plot(base, plot); });
  }
}

void print_accuracy(const std::vector<Solution>& solutions) {
  for (const Solution& solution : solutions) {
    std::printf("\n%s: %s\nerror: %s; reference: %s\n", solution.problem.name.c_str(),
                solution.problem.title.c_str(), solution.problem.error.c_str(),
                solution.problem.reference.c_str());
    const auto front = pareto_front(solution);
    for (std::size_t i = 0; i < solution.solved.size(); ++i) {
      const auto& [setting, found] = solution.solved[i];
      const bool on_front = std::find(front.begin(), front.end(), i) != front.end();
      std::printf("%c %-58s", on_front ? '*' : ' ', describe(solution, setting).c_str());
      if (found.failed.empty())
        std::printf(" %10.4f %% %9.3f s %8ld steps\n", 100 * found.error, found.seconds, found.steps);
      else
        std::printf(" %s\n", found.failed.c_str());
    }
    for (double target : kTargets)
      std::printf("cheapest within %4.1f %%: %s\n", 100 * target, cheapest_text(solution, target).c_str());
  }
}

}  // namespace hysteron::experiments
