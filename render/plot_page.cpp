#include "render/plot_page.h"

#include "render/gnuplot.h"
#include "sim/base/error.h"

namespace hysteron::render {
namespace {

// Lengths are in pixels.
constexpr int kLeft = 112, kRight = 26, kTop = 122, kBottom = 76;  // margins of the page around the plots
constexpr int kGapX = 110, kGapY = 134;  // gaps for an axis and, below each other, a title

std::string plot_commands(const gnuplot::PanelPage& page, int index, const PagePlot& one,
                          std::size_t first_series) {
  const Plot& plot = one.plot;
  return "reset\nset border 3 lw 1.2 lc rgb '#444444'\nset tics nomirror out scale 0.6\n"
         "set grid lc rgb '#E4E4E4' lw 0.8 lt 1\nset datafile missing 'NaN'\n" +
         page.margins(index) + "set key inside " + one.key +
         " vertical reverse Left samplen 1.6 spacing 1.15 font ',14' opaque fc rgb '#E8FFFFFF'\nset title " +
         gnuplot::label_text(plot.title) + " font ',17' offset 0,-0.3\n" +
         (plot.equal_scales ? "set size ratio -1\n" : "") + gnuplot::axis_commands("x", plot.x) +
         gnuplot::axis_commands("y", plot.y) + "set ylabel offset 1.2,0\n" +
         gnuplot::mark_commands(plot.marks) + gnuplot::plot_command(plot.series, first_series);
}

}  // namespace

void write_plot_page(const std::filesystem::path& base, const PlotPage& all) {
  gnuplot::require_something(base, all.plots.size());
  const int count = static_cast<int>(all.plots.size());
  const gnuplot::PanelPage page{count,  all.columns, all.plot_width, all.plot_height, kLeft,
                                kRight, kTop,        kBottom,        kGapX,           kGapY};
  std::string data,
      drawing = "set multiplot\n" + gnuplot::page_texts(page, all.title, all.subtitle, "", "") +
                "set border 0\nunset tics\nunset key\nset margins 0,0,0,0\nplot [0:1][0:1] NaN notitle\n";
  std::size_t series = 0;
  for (int i = 0; i < count; ++i) {
    gnuplot::require_drawable(base, all.plots[i].plot.series);
    data += gnuplot::data_blocks(all.plots[i].plot.series, series);
    drawing += plot_commands(page, i, all.plots[i], series);
    series += all.plots[i].plot.series.size();
  }
  gnuplot::write_both(base, page.width(), page.height(), data, drawing + "unset multiplot\n");
}

}  // namespace hysteron::render
