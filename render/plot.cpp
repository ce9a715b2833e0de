#include "render/plot.h"

#include "render/gnuplot.h"

namespace hysteron::render {
namespace {

std::string frame_commands(const Plot& plot) {
  std::string script =
      "set border 3 lw 1.2 lc rgb '#444444'\nset tics nomirror out scale 0.6\n"
      "set datafile missing 'NaN'\nset lmargin 11\nset bmargin 4\n";
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

}  // namespace

void write_plot(const std::filesystem::path& base, const Plot& plot) {
  gnuplot::require_drawable(base, plot.series);
  gnuplot::write_both(base, plot.width, plot.height, gnuplot::data_blocks(plot.series) + frame_commands(plot),
                      gnuplot::plot_command(plot.series));
}

}  // namespace hysteron::render
