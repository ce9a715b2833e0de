#include "render/plot.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "render/gnuplot.h"

namespace hysteron::render {
namespace {

std::string frame_commands(const Plot& plot) {
  std::string script =
      "set border 3 lw 1.2 lc rgb '#444444'\nset tics nomirror out scale 0.6\n"
      "set datafile missing 'NaN'\nset lmargin 11\nset style fill solid 0.9 noborder\n";
  script += "set bmargin " + std::string(plot.x.categories.empty() ? "4" : "8") + "\nset boxwidth " +
            gnuplot::number(plot.bar_width) + "\n";
  script += std::string("set key ") + (plot.key_inside ? "inside right bottom" : "outside right top") +
            " vertical reverse Left samplen 2.5 spacing 1.25\n";
  script += plot.axes_at_zero
                ? "set xzeroaxis lt 1 lw 1.2 lc rgb '#888888'\nset yzeroaxis lt 1 lw 1.2 lc rgb '#888888'\n"
                : "set grid lc rgb '#DDDDDD' lw 0.8 lt 1, lc rgb '#EEEEEE' lw 0.5 lt 1\n";
  script += "set title " + gnuplot::label_text(plot.title) + " font ',19' offset 0,0.3\n";
  if (plot.equal_scales) script += "set size ratio -1\n";
  return script + gnuplot::axis_commands("x", plot.x) + gnuplot::axis_commands("y", plot.y) +
         gnuplot::mark_commands(plot.marks);
}

// A logarithmic axis over less than two decades has limits of its own, from which it is numbered.
Axis limited(Axis axis, const std::vector<Series>& all, std::vector<double> Series::*values) {
  if (!axis.logarithmic || axis.low != axis.high) return axis;
  double low = std::numeric_limits<double>::infinity(), high = 0;
  for (const Series& series : all)
    for (double v : series.*values)
      if (std::isfinite(v) && v > 0) low = std::min(low, v), high = std::max(high, v);
  if (high > 0 && gnuplot::is_short(low, high)) {
    constexpr double kAir = 1.1;
    axis.low = low / kAir;
    axis.high = high * kAir;
  }
  return axis;
}

}  // namespace

std::vector<Series> grouped_bars(const std::vector<std::string>& labels,
                                 const std::vector<std::vector<double>>& values, double bar_width) {
  std::vector<Series> all;
  for (std::size_t s = 0; s < values.size(); ++s) {
    Series series{labels[s], {}, {}, Series::Style::bars};
    const double middle = (static_cast<double>(s) - (static_cast<double>(values.size()) - 1) / 2) * bar_width;
    for (std::size_t i = 0; i < values[s].size(); ++i) {
      series.x.push_back(static_cast<double>(i) + middle);
      series.y.push_back(values[s][i]);
    }
    all.push_back(std::move(series));
  }
  return all;
}

void write_plot(const std::filesystem::path& base, const Plot& drawn) {
  Plot plot = drawn;
  plot.x = limited(plot.x, plot.series, &Series::x);
  plot.y = limited(plot.y, plot.series, &Series::y);
  gnuplot::require_drawable(base, plot.series);
  gnuplot::write_both(base, plot.width, plot.height, gnuplot::data_blocks(plot.series) + frame_commands(plot),
                      gnuplot::plot_command(plot.series));
}

}  // namespace hysteron::render
