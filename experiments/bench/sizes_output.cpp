// How the time of a step grows with the number of triangles, as a table and curves.
#include <fmt/core.h>

#include "experiments/bench/sizes.h"
#include "experiments/bench/step_profile.h"
#include "experiments/workbench/pages/simulated_run.h"
#include "render/color_map.h"
#include "render/plot.h"

namespace hysteron::experiments {
namespace {

using render::Series;

// Rows of one integrator; x: triangles.
Series curve_of(const std::vector<Metrics>& rows, const Metrics& like, const char* key, std::string label,
                Series::Style style) {
  Series curve{std::move(label), {}, {}, style};
  for (const Metrics& row : rows) {
    if (row["integrator"] != like["integrator"]) continue;
    curve.x.push_back(row.number("triangles"));
    curve.y.push_back(row.number(key));
  }
  return curve;
}

// One row for each curve: those with the fewest triangles.
std::vector<const Metrics*> curves_in(const std::vector<Metrics>& rows) {
  std::vector<const Metrics*> first;
  for (const Metrics& row : rows)
    if (row.number("triangles") == rows.front().number("triangles")) first.push_back(&row);
  return first;
}

render::Plot plot_of(const SizeTable& table) {
  render::Plot plot{"Time of a step; dashed: its bytes at the bandwidth of a copy",
                    {"triangles", true},
                    {"time per step [ms]", true}};
  const std::vector<const Metrics*> curves = curves_in(table.rows);
  for (std::size_t k = 0; k < curves.size(); ++k) {
    const Metrics& like = *curves[k];
    Series measured =
        curve_of(table.rows, like, "ms_per_step", like["integrator"].text(), Series::Style::line_and_points);
    Series floor = curve_of(table.rows, like, "floor_ms_per_step", "", Series::Style::dashed);
    measured.color = floor.color = render::hex(render::method_color(k));
    plot.series.push_back(std::move(measured));
    plot.series.push_back(std::move(floor));
  }
  return plot;
}

FigureCaption caption_of(const SizeTable& table) {
  const Metrics& row = table.rows.front();
  return {
      "plot_sizes.png", "Time of a step by size",
      fmt::format("Median time of single steps of a square that hangs from two corners and has fallen for "
                  "0.2 s, in {} precision, on {}. Explicit and semi-implicit steps are as short as their "
                  "stability asks for, the others 1/60 s long (table.csv: step_s). Dashed: the bytes that "
                  "the loops of a step move at least, each array that a loop reads or writes counted once, "
                  "at the {:.0f} GB/s that a plain copy reaches here. Arrays that fit into a cache can be "
                  "moved faster.",
                  row["precision"].text(), table.device, 1e-9 * table.copy_bandwidth)};
}

}  // namespace

void write_sizes(Run& run, const SizeTable& table, bool pictures) {
  table_of(table.rows).write(run.path("table.csv"));
  if (table.device.empty()) return;
  run.manifest().device = table.device;
  run.metric("copy_bandwidth_GB_per_s", 1e-9 * table.copy_bandwidth);
  if (!pictures) return;
  run.plot("plot_sizes", plot_of(table));
  write_captions(run.path("README.md"), "Time of a step by size",
                 "What the figure of this folder shows; numbers in table.csv.", {caption_of(table)});
}

}  // namespace hysteron::experiments
