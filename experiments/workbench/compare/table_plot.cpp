#include "experiments/workbench/compare/table_plot.h"

#include <fmt/core.h>

#include "render/color_map.h"

namespace hysteron::experiments {
namespace {

render::Series series_of(const TablePlot& plot, const std::filesystem::path& folder,
                         const std::string& label) {
  render::Series series = render::series_from_csv(folder / plot.file, plot.x, plot.y, label);
  series.style = plot.style;
  for (double& y : series.y) y *= plot.scale;
  return series;
}

}  // namespace

void draw(Run& run, TablePlot plot, const std::string& label) {
  plot.plot.series.push_back(series_of(plot, run.folder(), label));
  run.plot(plot.name, plot.plot);
}

void draw(Run& run, TablePlot plot, const std::vector<SweepColumn>& columns) {
  const std::size_t given = plot.plot.series.size();
  for (std::size_t c = 0; c < columns.size(); ++c) {
    if (!columns[c].manifest || !std::filesystem::exists(columns[c].folder / plot.file)) continue;
    render::Series series = series_of(plot, columns[c].folder, columns[c].name);
    if (series.x.empty()) continue;
    const render::Rgb8 color = render::method_color(given + c);
    series.color = fmt::format("#{:02X}{:02X}{:02X}", color[0], color[1], color[2]);
    if (c >= render::kMethodColors) series.style = render::Series::Style::dashed;
    plot.plot.series.push_back(std::move(series));
  }
  if (plot.plot.series.size() > given) run.plot(plot.name, plot.plot);
}

}  // namespace hysteron::experiments
