#include "render/panels.h"

#include <algorithm>
#include <cmath>

#include "render/gnuplot.h"
#include "sim/base/error.h"

namespace hysteron::render {
namespace {

// Lengths are in pixels.
constexpr int kLeft = 96, kRight = 20, kTop = 104, kBottom = 76;  // margins of the page around the grid
constexpr int kGapX = 22, kGapY = 46;  // gaps between panels; a title fits into kGapY
constexpr double kRoom = 0.05;         // room beyond the data, over their extent

Axis fitted(const Axis& axis, const Panels& grid, std::vector<double> Series::*values) {
  if (axis.low != axis.high) return axis;
  double low = INFINITY, high = -INFINITY;
  for (const Panel& panel : grid.panels) {
    for (const Series& series : panel.series) {
      for (double v : series.*values) {
        if (std::isfinite(v)) low = std::min(low, v), high = std::max(high, v);
      }
    }
  }
  Axis result = axis;
  if (!(low < high)) return result;
  const double room = axis.logarithmic ? 0 : kRoom * (high - low);
  result.low = low - room, result.high = high + room;
  return result;
}

std::string corner_texts(const Panel& panel) {
  constexpr double kLine = 0.075;  // distance of lines, in heights of the panel
  std::string script;
  for (size_t i = 0; i < panel.notes.size(); ++i)
    script += gnuplot::text_at(panel.notes[i], "graph 0.03," + gnuplot::number(0.94 - kLine * i),
                               "left font ',12' front");
  for (size_t i = 0; i < panel.remarks.size(); ++i)
    script += gnuplot::text_at(panel.remarks[i],
                               "graph 0.97," + gnuplot::number(0.06 + kLine * (panel.remarks.size() - 1 - i)),
                               "right font ',12' front");
  return script;
}

std::string panel_commands(const gnuplot::PanelPage& page, int index, const Panel& panel,
                           std::size_t first_series) {
  return page.margins(index) + "set format x " + (page.lowest(index) ? "'% h'" : "''") + "\nset format y " +
         (page.first_column(index) ? "'% h'" : "''") + "\nset title " + gnuplot::label_text(panel.title) +
         " font ',15' offset 0,-0.6\n" + corner_texts(panel) +
         gnuplot::plot_command(panel.series, first_series) + "unset label\n";
}

std::string common_commands(const Panels& grid) {
  Axis x = fitted(grid.x, grid, &Series::x), y = fitted(grid.y, grid, &Series::y);
  x.label.clear(), y.label.clear();
  return "set border 15 lw 1 lc rgb '#AAAAAA'\nset tics nomirror out scale 0.4 font ',12' textcolor rgb "
         "'#444444'\nunset key\n"
         "set grid lc rgb '#E8E8E8' lw 0.8 lt 1\nset xzeroaxis lt 1 lw 1 lc rgb '#BBBBBB'\n"
         "set yzeroaxis lt 1 lw 1 lc rgb '#BBBBBB'\nset datafile missing 'NaN'\n" +
         gnuplot::axis_commands("x", x) + gnuplot::axis_commands("y", y);
}

}  // namespace

void write_panels(const std::filesystem::path& base, const Panels& grid) {
  gnuplot::require_something(base, grid.panels.size());
  for (const Panel& panel : grid.panels) gnuplot::require_drawable(base, panel.series);
  const int count = static_cast<int>(grid.panels.size()), columns = std::clamp(grid.columns, 1, count);
  const gnuplot::PanelPage page{
      count, columns, grid.panel_width, grid.panel_height, kLeft, kRight, kTop, kBottom, kGapX, kGapY};
  std::string data, drawing = "set multiplot\n" + gnuplot::page_texts(page, grid.title, grid.subtitle,
                                                                      grid.x.label, grid.y.label);
  std::size_t series = 0;
  for (int i = 0; i < count; ++i) {
    data += gnuplot::data_blocks(grid.panels[i].series, series);
    drawing += panel_commands(page, i, grid.panels[i], series);
    series += grid.panels[i].series.size();
  }
  gnuplot::write_both(base, page.width(), page.height(), data + common_commands(grid),
                      drawing + "unset multiplot\n");
}

}  // namespace hysteron::render
