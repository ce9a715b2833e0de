#include "experiments/workbench/compare/table_plot.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <tuple>

#include "experiments/workbench/app/law_family.h"
#include "experiments/workbench/compare/column_view.h"
#include "render/color_map.h"
#include "sim/scene/key_table.h"

namespace hysteron::experiments {
namespace {

render::Series table_series(const TablePlot& plot, const std::filesystem::path& folder,
                            const std::string& label) {
  render::Series series = render::series_from_csv(folder / plot.file, plot.x, plot.y, label);
  series.style = plot.style;
  for (double& y : series.y) y *= plot.scale;
  return series;
}

// The value at x on the line through the points of a series whose x rise; NaN beyond its ends.
double value_at(const render::Series& series, double x) {
  const auto after = std::lower_bound(series.x.begin(), series.x.end(), x);
  const auto i = static_cast<std::size_t>(after - series.x.begin());
  if (after == series.x.end() || (i == 0 && *after != x)) return NAN;
  if (*after == x) return series.y[i];
  const double share = (x - series.x[i - 1]) / (series.x[i] - series.x[i - 1]);
  return series.y[i - 1] + share * (series.y[i] - series.y[i - 1]);
}

// By how much half the step changes each value; empty where the column was not repeated so.
std::vector<double> step_spread(const TablePlot& plot, const ChildRun& column, const render::Series& series) {
  const std::filesystem::path repeat = column.folder / "errors" / "step";
  if (!std::filesystem::exists(repeat / plot.file)) return {};
  const render::Series half = table_series(plot, repeat, "");
  if (!std::is_sorted(half.x.begin(), half.x.end())) return {};
  std::vector<double> spread;
  for (std::size_t i = 0; i < series.x.size(); ++i) {
    const double change = std::abs(value_at(half, series.x[i]) - series.y[i]);
    spread.push_back(std::isfinite(change) ? change : 0);
  }
  return spread;
}

// Where a series that falls reaches that share of its first value.
std::optional<render::Mark> knee_mark(const render::Series& series, double share) {
  for (std::size_t i = 1; i < series.y.size(); ++i) {
    const double level = share * series.y[0];
    if (series.y[i] > level) continue;
    const double within = (series.y[i - 1] - level) / (series.y[i - 1] - series.y[i]);
    return render::Mark{
        "knee", series.x[i - 1] + within * (series.x[i] - series.x[i - 1]), level, 1, 0.6, series.color};
  }
  return std::nullopt;
}

double largest(const render::Series& series) {
  double most = 0;
  for (double y : series.y)
    if (std::isfinite(y)) most = std::max(most, std::abs(y));
  return most;
}

// Returns "prandtl" for "prandtl (integrator 7 %)".
std::string bare_name(const std::string& label) { return label.substr(0, label.find(" (")); }

// Removes the series that are zero compared with the others, or with rounding of sums, and returns their
// names.
std::vector<std::string> remove_zero_series(std::vector<render::Series>& all) {
  constexpr double kBeside = 1e-6, kLeft = 1e-12;
  double most = 0;
  for (const render::Series& series : all) most = std::max(most, largest(series));
  std::vector<std::string> names;
  std::erase_if(all, [&](const render::Series& series) {
    const bool nothing = largest(series) <= std::max(kLeft, kBeside * most);
    if (nothing) names.push_back(bare_name(series.label));
    return nothing;
  });
  return names;
}

// Unites lines that coincide into one with all their names, or with the first if these are many; returns the
// line that says so.
std::string unite_equal(std::vector<render::Series>& all) {
  constexpr double kSeen = 1e-3;     // share of the largest value
  constexpr std::size_t kMost = 30;  // characters of names at a line's end
  double most = 0;
  for (const render::Series& series : all) most = std::max(most, largest(series));
  const auto lie_on_each_other = [&](const render::Series& a, const render::Series& b) {
    if (a.x != b.x || a.y.size() != b.y.size()) return false;
    for (std::size_t i = 0; i < a.y.size(); ++i)
      if (!(std::abs(a.y[i] - b.y[i]) <= kSeen * most)) return false;
    return true;
  };
  std::string note;
  for (std::size_t i = 0; i < all.size(); ++i) {
    std::vector<std::string> others;
    for (std::size_t j = i + 1; j < all.size();) {
      if (!lie_on_each_other(all[i], all[j])) {
        ++j;
        continue;
      }
      others.push_back(bare_name(all[j].label));
      all.erase(all.begin() + static_cast<std::ptrdiff_t>(j));
    }
    if (others.empty()) continue;
    const std::string names = bare_name(all[i].label) + ", " + join(others, ", ");
    if (names.size() > kMost) note += "; as " + bare_name(all[i].label) + ": " + join(others, ", ");
    all[i].label = names.size() > kMost
                       ? bare_name(all[i].label) + " and " + std::to_string(others.size()) + " more"
                       : names;
  }
  return note;
}

// Returns the index of a value among the earlier ones; a new one is appended.
std::size_t place_in(std::vector<std::string>& values, const std::string& value) {
  const auto at = std::find(values.begin(), values.end(), value);
  const auto place = static_cast<std::size_t>(at - values.begin());
  if (at == values.end()) values.push_back(value);
  return place;
}

}  // namespace

void draw(Run& run, TablePlot plot, const std::string& law) {
  plot.plot.series.push_back(table_series(plot, run.folder(), law + ", simulated"));
  plot.plot.series.back().color = render::hex(color_of_law(law));
  run.plot(plot.name, plot.plot);
}

void draw(Run& run, TablePlot plot, const std::vector<ChildRun>& columns,
          const std::vector<std::string>& names) {
  const std::vector<render::Rgb8> colors = column_colors(columns);
  const std::vector<std::string> labels = column_labels(columns, names);
  std::vector<render::Series> own;
  for (std::size_t c = 0; c < columns.size(); ++c) {
    if (!columns[c].manifest || !std::filesystem::exists(columns[c].folder / plot.file)) continue;
    render::Series series = table_series(plot, columns[c].folder, labels[c]);
    if (series.x.empty()) continue;
    series.color = render::hex(colors[c]);
    series.spread = step_spread(plot, columns[c], series);
    if (const MetricValue knee = columns[c].metrics()[plot.knee]; !plot.knee.empty() && knee.is_number())
      if (const auto mark = knee_mark(series, knee.number())) plot.plot.marks.push_back(*mark);
    own.push_back(std::move(series));
  }
  const std::vector<std::string> nothing = remove_zero_series(own);
  if (own.empty()) return;
  const std::string united = unite_equal(own);
  const bool banded = std::ranges::any_of(own, [](const auto& series) { return !series.spread.empty(); });
  plot.plot.note = std::string("simulated") + (banded ? "; bands: the change by half the step" : "") +
                   (nothing.empty() ? "" : "; zero throughout: " + join(nothing, ", ")) + united;
  plot.plot.series.insert(plot.plot.series.end(), own.begin(), own.end());
  run.plot(plot.name, plot.plot);
}

void add_maps(render::HeatMaps& page, const Table& table, const MapColumns& columns,
              const std::function<render::HeatMapCell(const std::vector<std::size_t>& rows)>& cell) {
  std::vector<std::string> titles;
  std::map<std::tuple<std::size_t, std::size_t, std::size_t>, std::vector<std::size_t>> cells;
  for (std::size_t r = 0; r < table.rows.size(); ++r) {
    std::string title;
    for (const std::string& column : columns.panels)
      title += (title.empty() ? "" : ", ") + table.word(r, column);
    cells[{place_in(titles, title), place_in(page.y.ticks, table.word(r, columns.y)),
           place_in(page.x.ticks, table.word(r, columns.x))}]
        .push_back(r);
  }
  for (std::size_t m = 0; m < titles.size(); ++m) {
    const std::vector<render::HeatMapCell> blank(page.x.ticks.size());
    page.maps.push_back({titles[m], std::vector(page.y.ticks.size(), blank)});
  }
  for (const auto& [place, rows] : cells) {
    const auto& [map, y, x] = place;
    page.maps[map].rows[y][x] = cell(rows);
  }
}

}  // namespace hysteron::experiments
