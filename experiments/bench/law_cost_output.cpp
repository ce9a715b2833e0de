// What laws cost, as a table and bars.
#include "experiments/bench/law_cost.h"
#include "experiments/bench/table.h"
#include "experiments/workbench/pages/simulated_run.h"
#include "render/plot.h"

namespace hysteron::experiments {
namespace {

constexpr double kBarWidth = 0.38;

// A law's number on an element, in the order in which laws come.
std::vector<double> column(const std::vector<Metrics>& rows, const char* element, const char* key) {
  std::vector<double> values;
  for (const Metrics& row : rows)
    if (row["element"].text() == element) values.push_back(row[key].number());
  return values;
}

render::Plot bars(const std::vector<Metrics>& rows, const std::string& title, const std::string& label) {
  render::Plot plot{title, {""}, {label}};
  for (const Metrics& row : rows)
    if (row["element"].text() == "hinge") plot.x.categories.push_back(row["law"].text());
  plot.bar_width = kBarWidth;
  plot.y.logarithmic = true;
  return plot;
}

std::vector<FigureCaption> captions_of(const std::vector<Metrics>& rows) {
  const Metrics& row = rows.front();
  const std::string on = grouped(static_cast<long>(row["elements"].number())) + " elements at a time, in " +
                         row["precision"].text() + " precision, on " + row["device"].text() + ".";
  return {
      {"plot_cost.png", "What a law costs",
       "Time that the law alone takes for one element and step, without the element's geometry and the "
       "solver: one angle of a hinge, or the three curvatures of a shape element of a face; " +
           on + " A number behind a law is that of its stops, or of the reversals in its stack."},
      {"plot_error.png", "What a law misses",
       "Error of the moment against prandtl with a stack of 64 over 100 random histories of 200 turns within "
       "2 K0 either way: the largest and the root mean square, over M0; 0 has no bar."}};
}

}  // namespace

void write_law_costs(Run& run, const std::vector<Metrics>& rows, bool pictures) {
  write_table(run, rows);
  if (!pictures) return;
  render::Plot cost = bars(rows, "What a law costs", "time per element and step [ns]");
  cost.series = render::grouped_bars(
      {"hinge", "shape"}, {column(rows, "hinge", "ns_per_element"), column(rows, "shape", "ns_per_element")},
      kBarWidth);
  run.plot("plot_cost", cost);
  render::Plot error = bars(rows, "What a law misses", "error of the moment [% of M0]");
  error.series = render::grouped_bars({"largest", "root mean square"},
                                      {column(rows, "hinge", "largest_error_percent_of_M0"),
                                       column(rows, "hinge", "rms_error_percent_of_M0")},
                                      kBarWidth);
  error.y.low = 1e-3, error.y.high = 200;
  run.plot("plot_error", error);
  write_captions(run.path("README.md"), "Laws alone: time and error",
                 "What the figures of this folder show; numbers in table.csv.", captions_of(rows));
}

}  // namespace hysteron::experiments
