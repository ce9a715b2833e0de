// What laws cost, as a table and bars.
#include <nlohmann/json.hpp>

#include "experiments/bench/law_cost.h"
#include "experiments/workbench/pages/simulated_run.h"
#include "render/plot.h"
#include "sim/base/csv.h"

namespace hysteron::experiments {
namespace {

constexpr double kBarWidth = 0.38;

void write_table(Run& run, const Json& rows) {
  std::vector<CsvField> head;
  for (const auto& [key, value] : rows.front().items()) head.push_back(key);
  CsvFile file(run.path("table.csv"), head);
  for (const Json& row : rows) {
    std::vector<CsvField> fields;
    for (const auto& [key, value] : row.items())
      fields.push_back(value.is_string() ? CsvField(value.get<std::string>())
                                         : CsvField(value.get<double>()));
    file.row(fields);
  }
  file.commit();
}

// A law's number on an element, in the order in which laws come.
std::vector<double> column(const Json& rows, const char* element, const char* key) {
  std::vector<double> values;
  for (const Json& row : rows)
    if (row.at("element") == element) values.push_back(row.at(key).get<double>());
  return values;
}

render::Plot bars(const Json& rows, const std::string& title, const std::string& label) {
  render::Plot plot{title, {""}, {label}};
  for (const Json& row : rows)
    if (row.at("element") == "hinge") plot.x.categories.push_back(row.at("law").get<std::string>());
  plot.bar_width = kBarWidth;
  plot.y.logarithmic = true;
  return plot;
}

void draw(Run& run, const std::string& name, const render::Plot& plot) {
  run.plot(name, [&](const auto& base) { render::write_plot(base, plot); });
}

std::vector<FigureCaption> captions_of(const Json& rows) {
  const Json& row = rows.front();
  const std::string on = grouped(row.at("elements").get<long>()) + " elements at a time, in " +
                         row.at("precision").get<std::string>() + " precision, on " +
                         row.at("device").get<std::string>() + ".";
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

void write_law_costs(Run& run, const Json& rows, bool pictures) {
  write_table(run, rows);
  if (!pictures) return;
  render::Plot cost = bars(rows, "What a law costs", "time per element and step [ns]");
  cost.series = render::grouped_bars(
      {"hinge", "shape"}, {column(rows, "hinge", "ns_per_element"), column(rows, "shape", "ns_per_element")},
      kBarWidth);
  draw(run, "plot_cost", cost);
  render::Plot error = bars(rows, "What a law misses", "error of the moment [% of M0]");
  error.series = render::grouped_bars({"largest", "root mean square"},
                                      {column(rows, "hinge", "largest_error_percent_of_M0"),
                                       column(rows, "hinge", "rms_error_percent_of_M0")},
                                      kBarWidth);
  error.y.low = 1e-3, error.y.high = 200;
  draw(run, "plot_error", error);
  write_captions(run.path("README.md"), "Laws alone: time and error",
                 "What the figures of this folder show; numbers in table.csv.", captions_of(rows));
}

}  // namespace hysteron::experiments
