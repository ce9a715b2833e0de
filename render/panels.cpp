#include "render/panels.h"

#include <algorithm>
#include <cmath>

#include "render/gnuplot.h"
#include "sim/error.h"

namespace hysteron::render {
namespace {

// [pixels]
constexpr int kLeft = 96, kRight = 20, kTop = 104, kBottom = 76;  // of the page, around the grid
constexpr int kGapX = 22, kGapY = 46;                             // between panels; a title fits into kGapY
constexpr double kRoom = 0.05;                                    // beyond the data, of their extent

struct Page {
  const Panels& grid;
  int count, columns, rows;

  int width() const { return kLeft + columns * (grid.panel_width + kGapX) - kGapX + kRight; }
  int height() const { return kTop + rows * (grid.panel_height + kGapY) - kGapY + kBottom; }
  double across(double pixels) const { return pixels / width(); }
  double up(double pixels_from_top) const { return 1 - pixels_from_top / height(); }
};

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

std::string text_at(const std::string& text, const std::string& place, const std::string& rest) {
  return "set label " + gnuplot::label_text(text) + " at " + place + " " + rest + "\n";
}

std::string page_texts(const Page& page) {
  const auto screen = [](double x, double y) {
    return "screen " + gnuplot::number(x) + "," + gnuplot::number(y);
  };
  const double middle = page.across(kLeft + (page.width() - kLeft - kRight) / 2.0);
  return text_at(page.grid.title, screen(page.across(kLeft), page.up(28)), "left font ',19'") +
         text_at(page.grid.subtitle, screen(page.across(kLeft), page.up(56)),
                 "left font ',13' textcolor rgb '#555555'") +
         text_at(page.grid.x.label, screen(middle, page.up(page.height() - 16)), "center font ',15'") +
         text_at(page.grid.y.label,
                 screen(page.across(22), page.up(kTop + (page.height() - kTop - kBottom) / 2.0)),
                 "center rotate by 90 font ',15'");
}

std::string corner_texts(const Panel& panel) {
  constexpr double kLine = 0.075;  // distance of lines, in heights of the panel
  std::string script;
  for (size_t i = 0; i < panel.notes.size(); ++i)
    script +=
        text_at(panel.notes[i], "graph 0.03," + gnuplot::number(0.94 - kLine * i), "left font ',12' front");
  for (size_t i = 0; i < panel.remarks.size(); ++i)
    script += text_at(panel.remarks[i],
                      "graph 0.97," + gnuplot::number(0.06 + kLine * (panel.remarks.size() - 1 - i)),
                      "right font ',12' front");
  return script;
}

std::string panel_commands(const Page& page, int index, std::size_t first_series) {
  const Panel& panel = page.grid.panels[index];
  const int column = index % page.columns, row = index / page.columns;
  const int left = kLeft + column * (page.grid.panel_width + kGapX),
            top = kTop + row * (page.grid.panel_height + kGapY);
  const auto margin = [](const char* side, double at) {
    return std::string("set ") + side + "margin at screen " + gnuplot::number(at) + "\n";
  };
  const bool lowest = index + page.columns >= page.count;
  return margin("l", page.across(left)) + margin("r", page.across(left + page.grid.panel_width)) +
         margin("t", page.up(top)) + margin("b", page.up(top + page.grid.panel_height)) + "set format x " +
         (lowest ? "'% h'" : "''") + "\nset format y " + (column == 0 ? "'% h'" : "''") + "\nset title " +
         gnuplot::label_text(panel.title) + " font ',15' offset 0,-0.6\n" + corner_texts(panel) +
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
  if (grid.panels.empty()) throw Error::request("plot " + base.string() + ": there is nothing to draw");
  for (const Panel& panel : grid.panels) gnuplot::require_drawable(base, panel.series);
  const int count = static_cast<int>(grid.panels.size()), columns = std::clamp(grid.columns, 1, count);
  const Page page{grid, count, columns, (count + columns - 1) / columns};
  std::string data, drawing = "set multiplot\n" + page_texts(page);
  std::size_t series = 0;
  for (int i = 0; i < count; ++i) {
    data += gnuplot::data_blocks(grid.panels[i].series, series);
    drawing += panel_commands(page, i, series);
    series += grid.panels[i].series.size();
  }
  gnuplot::write_both(base, page.width(), page.height(), data + common_commands(grid),
                      drawing + "unset multiplot\n");
}

}  // namespace hysteron::render
