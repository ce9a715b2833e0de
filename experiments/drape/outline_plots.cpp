#include "experiments/drape/outline_plots.h"

#include <fmt/core.h>

#include <cmath>
#include <numbers>

#include "experiments/workbench/compare/column_view.h"
#include "render/color_map.h"
#include "render/plot_page.h"
#include "sim/base/csv.h"

namespace hysteron::experiments {
namespace {

constexpr const char* kFile = "outline.csv";
constexpr double kCentimetres = 100;
constexpr const char* kFirstColor = "#777777";

using Style = render::Series::Style;

// A closed line of that radius [cm] at equal angles.
render::Series closed_line(const std::string& label, const std::vector<double>& radius, Style style,
                           const std::string& color) {
  render::Series series{label, {}, {}, style, color};
  const std::size_t n = radius.size();
  for (std::size_t k = 0; k <= n; ++k) {
    const double angle = 2 * std::numbers::pi * static_cast<double>(k) / static_cast<double>(n);
    series.add(radius[k % n] * std::cos(angle), radius[k % n] * std::sin(angle));
  }
  return series;
}

std::vector<double> in_centimetres(const Outline& outline) {
  std::vector<double> radius = outline.radius;
  for (double& r : radius) r *= kCentimetres;
  return radius;
}

render::Series circle(double radius, const std::string& label) {
  return closed_line(label, std::vector<double>(360, kCentimetres * radius), Style::dashed, "#AAAAAA");
}

// The column's first and last outline over each other.
render::PagePlot history_panel(const ChildRun& column, const std::string& name, const std::string& color) {
  const render::Series both = render::series_from_csv(column.folder / kFile, "first_radius", "radius", "");
  const double same = column.metrics()["outline_overlap"].number();
  render::Plot plot{fmt::format("{}: {:.1f} % the same", name, 100 * same), {"x [cm]"}, {"y [cm]"}};
  plot.equal_scales = true;
  plot.series = {closed_line("lowered", both.x, Style::line, kFirstColor),
                 closed_line("lifted flat and lowered again", both.y, Style::line, color)};
  plot.series[0].line_width = 5;
  return {plot, "center center"};
}

}  // namespace

void write_outlines(Run& run, const DrapeOutlines& outlines) {
  std::vector<std::string> head = {"angle [degree]", "radius [cm]"};
  if (outlines.first) head.emplace_back("first_radius [cm]");
  Table table(head);
  const std::size_t n = outlines.last.radius.size();
  for (std::size_t k = 0; k < n; ++k) {
    std::vector<Cell> row = {360.0 * static_cast<double>(k) / static_cast<double>(n),
                             kCentimetres * outlines.last.radius[k]};
    if (outlines.first) row.emplace_back(kCentimetres * outlines.first->radius[k]);
    table.row(row);
  }
  table.write(run.path(kFile));
}

void plot_outlines(Session& session, const DrapeParams& choice, double radius,
                   const DrapeOutlines& outlines) {
  render::Plot plot{"Outline from above, " + session.scene().fabric.name, {"x [cm]"}, {"y [cm]"}};
  plot.equal_scales = true;
  if (outlines.first)
    plot.series.push_back(
        closed_line("simulated, lowered once", in_centimetres(*outlines.first), Style::line, kFirstColor));
  plot.series.push_back(closed_line(outlines.first ? "simulated, lowered again" : "simulated",
                                    in_centimetres(outlines.last), Style::line, session.law_color()));
  plot.series.push_back(circle(choice.disc, "pedestal"));
  plot.series.push_back(circle(radius, "flat specimen"));
  session.plot("plot_outline", plot);
}

void plot_histories(Run& run, const ComparisonPage& page, const std::vector<ChildRun>& columns) {
  render::PlotPage panels;
  panels.title = page.title + ": the same load along two histories";
  panels.subtitle = "simulated, from above; " + join(page.notes, " ");
  panels.plot_height = panels.plot_width;
  const std::vector<std::string> names = column_names(columns, page.names);
  const std::vector<render::Rgb8> colors = column_colors(columns);
  for (std::size_t c = 0; c < columns.size(); ++c)
    if (columns[c].metrics()["outline_overlap"].is_number())
      panels.plots.push_back(history_panel(columns[c], names[c], render::hex(colors[c])));
  if (panels.plots.empty()) return;
  run.plot("plot_histories", panels, render::write_plot_page);
}

}  // namespace hysteron::experiments
