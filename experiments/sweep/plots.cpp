// Draws the curves and maps of a study.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "experiments/sweep/tables.h"
#include "experiments/workbench/app/headlines.h"
#include "experiments/workbench/compare/table_plot.h"
#include "experiments/workbench/pages/manifest.h"
#include "render/color_map.h"
#include "render/panels.h"
#include "render/plot.h"
#include "sim/base/number_in.h"

namespace hysteron::experiments {
namespace {

constexpr std::size_t kMaxPanels = 24;
const char* const kColorNames[render::kMethodColors] = {"blue",     "vermilion", "green", "pink",
                                                        "sky blue", "orange",    "black"};

// A metric with its words and axis label: "tip drop over length", "lost to friction in bending [mJ]".
struct ShownMetric {
  std::string name, words, label;
  double scale = 1;
};

ShownMetric shown_metric(const std::string& experiment, const std::string& metric) {
  for (const Headline& headline : experiment_headlines(experiment).all) {
    const std::string unit = headline.unit, words = headline.words;
    if (headline.metric == metric)
      return {metric, words, words + (unit.empty() ? "" : " [" + unit + "]"), headline.scale};
  }
  const NamedUnit parts = split_unit(metric);
  return {metric, parts.name, parts.text()};
}

// The runs grouped by their values along some axes, "dahl, 0.1", in the order of the study.
using Groups = std::vector<std::pair<std::string, std::vector<std::size_t>>>;

class StudyPlots {
 public:
  StudyPlots(Run& run, const Study& study) : run_(run), study_(study) {
    for (std::size_t a = 0; a < study.axes.size(); ++a)
      if (!is_seed(study.axes[a]) && study.axes[a].values.size() > 1) free_.push_back(a);
  }

  void draw(const ShownMetric& metric, const std::vector<double>& numbers) {
    for (const std::size_t x : free_)
      if (study_.axes[x].numeric) draw_curves(metric, numbers, x);
    draw_map(metric, numbers);
    if (std::none_of(free_.begin(), free_.end(), [&](std::size_t a) { return study_.axes[a].numeric; }))
      draw_bars(metric, numbers);
  }

 private:
  const StudyAxis& axis(std::size_t a) const { return study_.axes[a]; }
  std::string label(const StudyAxis& axis) const {
    return axis.key + (axis.unit.empty() ? "" : " [" + axis.unit + "]");
  }
  std::string shown_value(std::size_t a, std::size_t run) const {
    const std::string& text = study_.runs[run].values[a];
    return axis(a).numeric ? text : std::filesystem::path(text).stem().string();
  }

  std::string group_name(std::size_t run, const std::vector<std::size_t>& axes) const {
    std::string name;
    for (const std::size_t a : axes)
      name += (name.empty() ? "" : ", ") + (axis(a).numeric ? axis(a).key + " " : "") + shown_value(a, run);
    return name;
  }

  Groups grouped(const std::vector<std::size_t>& which, const std::vector<std::size_t>& axes) const {
    Groups groups;
    std::map<std::string, std::size_t> places;
    for (const std::size_t r : which) {
      const std::string name = group_name(r, axes);
      const auto [place, is_new] = places.emplace(name, groups.size());
      if (is_new) groups.push_back({name, {}});
      groups[place->second].second.push_back(r);
    }
    return groups;
  }

  std::vector<std::size_t> all() const {
    std::vector<std::size_t> every(study_.runs.size());
    std::iota(every.begin(), every.end(), std::size_t{0});
    return every;
  }

  double axis_value(std::size_t a, std::size_t run) const { return *number_in(study_.runs[run].values[a]); }

  // Adds dots for the runs and, on a grid, a line through their means at each value.
  void add_series(std::vector<render::Series>& series, const std::string& name, std::size_t color,
                  const std::vector<std::size_t>& which, std::size_t x,
                  const std::vector<double>& numbers) const {
    render::Series dots{
        name, {}, {}, render::Series::Style::points, render::hex(render::method_color(color))};
    std::map<double, std::pair<double, int>> sums;
    for (const std::size_t r : which) {
      if (std::isnan(numbers[r])) continue;
      dots.add(axis_value(x, r), numbers[r]);
      auto& [sum, count] = sums[dots.x.back()];
      sum += numbers[r], ++count;
    }
    if (dots.x.empty()) return;
    if (!axis(x).sampled) {
      render::Series line{"", {}, {}, render::Series::Style::line, dots.color};
      for (const auto& [at, sum] : sums) line.add(at, sum.first / sum.second);
      series.push_back(std::move(line));
    }
    series.push_back(std::move(dots));
  }

  // Returns the axis that colours the curves, the first with few enough values for a colour each, texts
  // before numbers; nothing if there is none.
  std::vector<std::size_t> colored_by(std::size_t x) const {
    std::vector<std::size_t> best;
    for (const std::size_t a : free_) {
      const std::size_t size = axis(a).values.size();
      if (a == x || axis(a).sampled || size > render::kMethodColors) continue;
      if (best.empty() || (axis(best[0]).numeric && !axis(a).numeric)) best = {a};
    }
    return best;
  }

  void draw_curves(const ShownMetric& metric, const std::vector<double>& numbers, std::size_t x) {
    const std::vector<std::size_t> color = colored_by(x);
    std::vector<std::size_t> others;
    for (const std::size_t a : free_)
      if (a != x && !axis(a).sampled && !std::count(color.begin(), color.end(), a)) others.push_back(a);
    const Groups panels = grouped(all(), others);
    const std::string name = "plot_" + metric.name + "-" + axis(x).key;
    if (panels.size() > kMaxPanels) {
      run_.warn(fmt::format("{}: {} panels are too many to be drawn", name, panels.size()));
      return;
    }
    render::Panels page{fmt::format("{}: {} over {}", study_.experiment, metric.words, axis(x).key),
                        "dots: runs" + std::string(axis(x).sampled ? "" : "; lines: means"),
                        {label(axis(x)), axis(x).logarithmic},
                        {metric.label},
                        {}};
    const Groups colors = grouped(all(), color);
    for (std::size_t c = 0; !color.empty() && c < colors.size(); ++c)
      page.subtitle += fmt::format("; {}: {}", kColorNames[c], colors[c].first);
    for (const auto& [title, which] : panels) {
      render::Panel panel{title, {}};
      for (const auto& [value, of_value] : grouped(which, color))
        add_series(panel.series, value, group_index(colors, value), of_value, x, numbers);
      if (!panel.series.empty()) page.panels.push_back(std::move(panel));
    }
    if (page.panels.empty()) return;
    if (page.panels.size() == 1) return draw_one(name, page);
    page.columns = static_cast<int>(std::min<std::size_t>(page.panels.size(), 3));
    run_.plot(name, page, render::write_panels);
  }

  static std::size_t group_index(const Groups& groups, const std::string& name) {
    return static_cast<std::size_t>(
        std::find_if(groups.begin(), groups.end(), [&](const auto& group) { return group.first == name; }) -
        groups.begin());
  }

  // Draws a page of one panel as a plot, whose key names the colours.
  void draw_one(const std::string& name, const render::Panels& page) {
    render::Plot plot{page.title, page.x, page.y};
    plot.series = page.panels.front().series;
    run_.plot(name, plot);
  }

  void draw_bars(const ShownMetric& metric, const std::vector<double>& numbers) {
    if (free_.empty() || free_.size() > 2) return;
    const Groups categories = grouped(all(), {free_.back()});
    const Groups series =
        grouped(all(), free_.size() > 1 ? std::vector{free_.front()} : std::vector<std::size_t>{});
    render::Plot plot{study_.experiment + ": " + metric.words, {axis(free_.back()).key}, {metric.label}};
    std::vector<std::string> labels;
    std::vector<std::vector<double>> values;
    for (const auto& category : categories) plot.x.categories.push_back(category.first);
    for (const auto& [name, which] : series) {
      labels.push_back(name);
      values.emplace_back();
      for (const auto& [category, all_of_it] : categories)
        values.back().push_back(selected_mean(numbers, common(which, all_of_it)).value);
    }
    plot.series = render::grouped_bars(labels, values, plot.bar_width);
    run_.plot("plot_" + metric.name + "-" + axis(free_.back()).key, plot);
  }

  static std::vector<std::size_t> common(const std::vector<std::size_t>& a,
                                         const std::vector<std::size_t>& b) {
    std::vector<std::size_t> both;
    std::set_intersection(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(both));
    return both;
  }

  void draw_map(const ShownMetric& metric, const std::vector<double>& numbers) {
    std::vector<std::size_t> grid = free_;
    std::erase_if(grid, [&](std::size_t a) { return axis(a).sampled; });
    if (grid.size() < 2) return;
    std::stable_sort(grid.begin(), grid.end(), [&](std::size_t a, std::size_t b) {
      return axis(a).values.size() > axis(b).values.size();
    });
    const std::size_t x = grid[0], y = grid[1];
    const std::string name = "plot_" + metric.name + "-map";
    Table runs("panel,x,y");
    for (std::size_t r = 0; r < study_.runs.size(); ++r)
      runs.row({group_name(r, {grid.begin() + 2, grid.end()}), shown_value(x, r), shown_value(y, r)});
    if (const std::size_t count = runs.values("panel").size(); count > kMaxPanels) {
      run_.warn(fmt::format("{}: {} maps are too many to be drawn", name, count));
      return;
    }
    render::HeatMaps page{study_.experiment + ": " + metric.label,
                          "Number: mean of the runs.",
                          {label(axis(x)), {}},
                          {label(axis(y)), {}},
                          {},
                          {}};
    page.cell_width = 70;
    std::vector<double> means;  // by the cells' kinds
    add_maps(page, runs, {{"panel"}, "x", "y"}, [&](const std::vector<std::size_t>& which) {
      means.push_back(selected_mean(numbers, which).value);
      return render::HeatMapCell{static_cast<int>(means.size()) - 1, ""};
    });
    if (!color_cells(page, means)) return;
    if (!axis(y).numeric) {  // so that names are read from above
      std::reverse(page.y.ticks.begin(), page.y.ticks.end());
      for (render::HeatMap& map : page.maps) std::reverse(map.rows.begin(), map.rows.end());
    }
    run_.plot(name, page, render::write_heat_maps);
  }

  // Colours cells, whose kinds are indices into `means`, by equal parts of the range of all; the colours are
  // light, so that numbers can be read on them.  Returns false if no mean is known.
  static bool color_cells(render::HeatMaps& page, const std::vector<double>& means) {
    constexpr int kParts = 5;
    constexpr float kDarkest = 0.55f;
    double low = INFINITY, high = -INFINITY;
    for (const double x : means)
      if (!std::isnan(x)) low = std::min(low, x), high = std::max(high, x);
    if (!(low <= high)) return false;
    const double part = (high - low) / kParts;
    for (int k = 0; k < kParts; ++k)
      page.kinds.push_back({fmt::format("{:.3g} to {:.3g}", low + k * part, low + (k + 1) * part),
                            render::hex(render::map_color8(
                                render::ColorMap::sequential,
                                kDarkest + (1 - kDarkest) * static_cast<float>(k) / (kParts - 1)))});
    for (render::HeatMap& map : page.maps)
      for (auto& row : map.rows)
        for (render::HeatMapCell& cell : row) {
          const double x = cell.kind < 0 ? NAN : means[static_cast<std::size_t>(cell.kind)];
          const int kind = part > 0 ? std::min(kParts - 1, static_cast<int>((x - low) / part)) : 0;
          cell = std::isnan(x) ? render::HeatMapCell{} : render::HeatMapCell{kind, number_text(x, 3)};
        }
    return true;
  }

  Run& run_;
  const Study& study_;
  std::vector<std::size_t> free_;  // axes with several values, except that of repeated draws
};

}  // namespace

void plot_study(Run& run, const Study& study, const std::vector<ChildRun>& runs,
                const std::vector<std::string>& metrics) {
  StudyPlots plots(run, study);
  for (const std::string& name : metrics) {
    const ShownMetric metric = shown_metric(study.experiment, name);
    std::vector<double> numbers = metric_values(runs, name);
    for (double& number : numbers) number *= metric.scale;
    plots.draw(metric, numbers);
  }
}

}  // namespace hysteron::experiments
