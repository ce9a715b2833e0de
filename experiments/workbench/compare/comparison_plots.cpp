// Draws the plots of a comparison, with a line or a bar for each column.
#include <algorithm>
#include <cmath>

#include "experiments/workbench/compare/column_view.h"
#include "experiments/workbench/compare/comparison_page.h"
#include "experiments/workbench/compare/table_plot.h"
#include "experiments/workbench/pages/error_notes.h"
#include "experiments/workbench/pages/manifest.h"
#include "render/color_map.h"

namespace hysteron::experiments {
namespace {

// Returns a list, of series or of curves, from the first column whose list is not empty.
template <class List>
List first_list(const std::vector<ChildRun>& columns, List (*noted)(const Manifest&)) {
  for (const ChildRun& c : columns)
    if (c.manifest && !noted(*c.manifest).empty()) return noted(*c.manifest);
  return {};
}

// Returns "probe1_curvature_warp [1/m]" as the title of an axis.
std::string axis_title(std::string column) {
  std::replace(column.begin(), column.end(), '_', ' ');
  return column;
}

// Plots the experiment's own columns of metrics.csv against time.
void plot_series(Run& run, const ComparisonPage& page, const std::vector<ChildRun>& columns) {
  using Names = std::vector<std::string>;
  for (const std::string& name :
       first_list<Names>(columns, [](const Manifest& m) { return m.series.value_or(Names{}); })) {
    const std::string word = name.substr(0, name.find(" ["));
    draw(run,
         TablePlot{
             "plot_" + word, {page.title, {"time [s]"}, {axis_title(name)}}, "metrics.csv", "time", word},
         columns, page.names);
  }
}

// Plots the tables that the experiment names in its manifest.
void plot_curves(Run& run, const ComparisonPage& page, const std::vector<ChildRun>& columns) {
  for (const Curve& curve :
       first_list<std::vector<Curve>>(columns, [](const Manifest& m) { return m.curves; })) {
    const bool probed = curve.plot.starts_with("plot_probe");
    draw(run,
         TablePlot{curve.plot,
                   {page.title,
                    {axis_title(curve.x), curve.logarithmic_x},
                    {axis_title(curve.y), curve.logarithmic}},
                   curve.file,
                   curve.x,
                   curve.y,
                   probed ? render::Series::Style::line : render::Series::Style::line_and_points,
                   1,
                   curve.knee},
         columns, page.names);
  }
}

// Returns the error of step, mesh and draw together, or of a fit; NaN if none is known.
double error_of(const Metrics& metrics, const std::string& key) {
  double square = 0;
  for (const char* ending : {kStepError, kMeshError, kDrawError, kStandardError})
    if (const MetricValue error = metrics[key + ending]; error.is_number())
      square += error.number() * error.number();
  return square > 0 ? std::sqrt(square) : NAN;
}

// Draws the page's metrics, or these default headlines, as a bar per column; no plot if all are zero.
void plot_answers(Run& run, const ComparisonPage& page, const std::vector<ChildRun>& columns) {
  const std::vector<std::string> default_metrics = {"drape_coefficient_percent", "recovery_angle_deg"};
  for (const std::string& key : page.metrics.empty() ? default_metrics : page.metrics) {
    render::Plot plot{page.title, {""}, {split_unit(key).text()}};
    plot.note = "simulated";
    const std::vector<std::string> labels = column_labels(columns, page.names);
    const std::vector<render::Rgb8> colors = column_colors(columns);
    std::vector<double> values, errors;
    for (std::size_t c = 0; c < columns.size(); ++c) {
      const MetricValue value = columns[c].metrics()[key];
      if (!value.is_number()) continue;
      const double place = static_cast<double>(values.size());
      plot.series.push_back(
          {"", {place}, {value.number()}, render::Series::Style::bars, render::hex(colors[c])});
      plot.x.categories.push_back(labels[c]);
      values.push_back(value.number());
      errors.push_back(error_of(columns[c].metrics(), key));
    }
    if (values.size() < 2) continue;
    if (const render::Series bars = render::bar_errors(values, errors); !bars.x.empty()) {
      plot.series.push_back(bars);
      plot.note += "; lines: errors of step, mesh and draw";
    }
    const auto [least, most] = std::minmax_element(values.begin(), values.end());
    plot.y.low = 1.05 * std::min(0.0, *least);
    plot.y.high = 1.05 * std::max(0.0, *most);
    if (plot.y.low == plot.y.high) plot.y.high = 1;
    run.plot("plot_" + key, plot);
  }
}

}  // namespace

void plot_comparison(Run& run, const ComparisonPage& page, const std::vector<ChildRun>& columns) {
  plot_series(run, page, columns);
  plot_curves(run, page, columns);
  plot_answers(run, page, columns);
}

}  // namespace hysteron::experiments
