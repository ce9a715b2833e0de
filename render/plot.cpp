#include "render/plot.h"

#include <fmt/core.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iterator>
#include <limits>

#include "render/color_map.h"
#include "render/gnuplot.h"
#include "sim/base/csv.h"
#include "sim/base/whole_file.h"

namespace hysteron::render {
namespace {

std::string frame_commands(const Plot& plot) {
  std::string script =
      "set border 3 lw 1.2 lc rgb '#444444'\nset tics nomirror out scale 0.6\n"
      "set datafile missing 'NaN'\nset lmargin 11\nset style fill solid 0.9 noborder\n";
  script += "set bmargin " + std::string(plot.x.categories.empty() ? "4" : "8") + "\nset boxwidth " +
            gnuplot::number(plot.bar_width) + "\n";
  script += plot.key_inside
                ? "set key inside " + key_corner(plot) + " vertical reverse Left samplen 2.5 spacing 1.25\n"
                : "unset key\n";
  script += plot.axes_at_zero
                ? "set xzeroaxis lt 1 lw 1.2 lc rgb '#888888'\nset yzeroaxis lt 1 lw 1.2 lc rgb '#888888'\n"
                : "set grid lc rgb '#DDDDDD' lw 0.8 lt 1, lc rgb '#EEEEEE' lw 0.5 lt 1\n";
  script += "set title " + gnuplot::label_text(plot.title) + " font ',19' offset 0," +
            (plot.note.empty() ? "0.3\n" : "1.2\nset tmargin 5\n");
  std::string note;
  if (!plot.note.empty()) {
    // The note stands below the title over the plot's middle; a long one is over the picture's, and small.
    constexpr std::size_t kLong = 60, kTooLong = 100;  // letters
    note = "set label " + gnuplot::label_text(plot.note) + " at " +
           (plot.note.size() > kLong ? "screen 0.5,graph 1.03" : "graph 0.5,1.03") + " center font '," +
           (plot.note.size() > kTooLong ? "11" : "14") + "' textcolor rgb '#666666'\n";
  }
  if (plot.equal_scales) script += "set size ratio -1\n";
  return script + gnuplot::axis_commands("x", plot.x) + gnuplot::axis_commands("y", plot.y) +
         gnuplot::mark_commands(plot.marks) + note;
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

// Returns true for a label whose unit takes prefixes: "tip height [m]".
bool takes_prefix(const std::string& label) {
  const std::size_t open = label.rfind('['), close = label.rfind(']');
  if (open == std::string::npos || close == std::string::npos || close < open) return false;
  const std::string unit = label.substr(open + 1, close - open - 1);
  static const std::vector<std::string> kUnits = {"N",   "J",   "m",   "s",     "Pa",   "W",
                                                  "N m", "N/m", "J/m", "J/m^2", "J/m²", "m/s"};
  return std::find(kUnits.begin(), kUnits.end(), unit) != kUnits.end();
}

// Numbers below a tenth of the unit get the prefix that leaves the largest from 1 to 999.
void prefix(Plot& plot, Axis& axis, std::vector<double> Series::*values, double Mark::*place) {
  constexpr double kSmall = 0.1;
  if (!takes_prefix(axis.label)) return;
  double most = std::max(std::abs(axis.low), std::abs(axis.high));
  for (const Series& series : plot.series)
    for (double v : series.*values)
      if (std::isfinite(v)) most = std::max(most, std::abs(v));
  if (!(most > 0 && most < kSmall)) return;
  const SiPrefix si = si_prefix(most);
  axis.label.insert(axis.label.rfind('[') + 1, si.prefix);
  axis.low /= si.factor;
  axis.high /= si.factor;
  for (Series& series : plot.series)
    for (double& v : series.*values) v /= si.factor;
  if (values == &Series::y)
    for (Series& series : plot.series)
      for (double& v : series.spread) v /= si.factor;
  for (Mark& mark : plot.marks) mark.*place /= si.factor;
}

bool is_labelled(const Series& series) {
  return !series.label.empty() && series.style != Series::Style::bars;
}

bool has_end_labels(const Plot& plot) {
  return !plot.key_inside && plot.x.categories.empty() &&
         std::count_if(plot.series.begin(), plot.series.end(), is_labelled) > 1;
}

// Gives an axis limits a little beyond the data, so that it is known where lines end.
Axis bounded(Axis axis, const std::vector<Series>& all, std::vector<double> Series::*values, double air) {
  if (axis.low != axis.high) return axis;
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const Series& series : all)
    for (double v : series.*values)
      if (std::isfinite(v) && (!axis.logarithmic || v > 0)) low = std::min(low, v), high = std::max(high, v);
  if (!(low <= high)) return axis;
  if (axis.logarithmic) {
    axis.low = low / (1 + air);
    axis.high = high * (1 + air);
  } else {
    const double room = air * (high > low ? high - low : std::max(1.0, std::abs(high)));
    axis.low = low - room;
    axis.high = high + room;
  }
  return axis;
}

// Returns where a value lies on an axis with limits, from 0 at its low end to 1.
double place_on(const Axis& axis, double value) {
  const auto scaled = [&](double v) { return axis.logarithmic ? std::log10(v) : v; };
  return (scaled(value) - scaled(axis.low)) / (scaled(axis.high) - scaled(axis.low));
}

// Returns points of all series, those of lines also between their data, from (0, 0) at the lower left corner
// to (1, 1).
std::vector<Eigen::Vector2d> drawn_points(const Plot& plot) {
  constexpr int kBetween = 8;
  const Axis x = bounded(plot.x, plot.series, &Series::x, 0), y = bounded(plot.y, plot.series, &Series::y, 0);
  std::vector<Eigen::Vector2d> points;
  for (const Series& series : plot.series) {
    const bool is_line = series.style != Series::Style::points && series.style != Series::Style::rings;
    Eigen::Vector2d before(NAN, NAN);
    for (std::size_t i = 0; i < std::min(series.x.size(), series.y.size()); ++i) {
      const Eigen::Vector2d here(place_on(x, series.x[i]), place_on(y, series.y[i]));
      for (int k = 1; is_line && k < kBetween; ++k) points.push_back(before + (here - before) * k / kBetween);
      points.push_back(here);
      before = here;
    }
  }
  std::erase_if(points, [](const Eigen::Vector2d& p) { return !p.allFinite(); });
  return points;
}

// Where all values lie within a tenth of the largest, the axis spans that tenth: noise does not fill the
// plot.
Axis not_stretched(Axis axis, const std::vector<Series>& all, std::vector<double> Series::*values) {
  constexpr double kLeast = 0.1;
  if (axis.low != axis.high || axis.logarithmic) return axis;
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const Series& series : all)
    for (double v : series.*values)
      if (std::isfinite(v)) low = std::min(low, v), high = std::max(high, v);
  const double least = kLeast * std::max(std::abs(low), std::abs(high));
  if (!(low < high) || high - low >= least) return axis;
  axis.low = (low + high - least) / 2;
  axis.high = (low + high + least) / 2;
  return axis;
}

struct EndLabel {
  std::size_t series;
  double at, end;  // the label's middle and the line's end, in heights of the plot
  bool reaches;    // true if the line reaches the right border, where the label is
};

// Returns labels where lines end, from the lowest, moved apart by `step` as near to there as order allows.
std::vector<EndLabel> end_labels(const Plot& plot, double step) {
  constexpr double kNear = 0.01;  // distance from the axis's end at which a line reaches it, over its length
  const auto height = [&](double y) {
    const double t = plot.y.logarithmic ? std::log(y / plot.y.low) / std::log(plot.y.high / plot.y.low)
                                        : (y - plot.y.low) / (plot.y.high - plot.y.low);
    return std::clamp(t, 0.0, 1.0);
  };
  std::vector<EndLabel> labels;
  for (std::size_t s = 0; s < plot.series.size(); ++s) {
    if (!is_labelled(plot.series[s])) continue;
    double end = 0;
    for (double y : plot.series[s].y)
      if (std::isfinite(y) && (!plot.y.logarithmic || y > 0)) end = height(y);
    const double last = plot.series[s].x.back(), near = plot.x.high - kNear * (plot.x.high - plot.x.low);
    labels.push_back({s, end, end, last >= near});
  }
  std::stable_sort(labels.begin(), labels.end(),
                   [](const EndLabel& a, const EndLabel& b) { return a.end < b.end; });
  step = std::min(step, 1.0 / static_cast<double>(labels.size()));
  for (std::size_t i = 1; i < labels.size(); ++i)
    labels[i].at = std::max(labels[i].at, labels[i - 1].at + step);
  double top = 1;
  for (std::size_t i = labels.size(); i-- > 0; top -= step) labels[i].at = std::min(labels[i].at, top);
  return labels;
}

std::string series_color(const Plot& plot, std::size_t series) {
  return plot.series[series].color.empty() ? hex(method_color(series)) : plot.series[series].color;
}

// Draws labels beside the plot, with leaders to lines that end at the right border.
std::string end_label_commands(const Plot& plot) {
  constexpr double kLetters = 14, kAround = 160;  // height of letters, and of title and axes [pixels]
  constexpr double kLeader = 0.018, kAir = 0.006;
  const double step = 1.35 * kLetters / std::max(1.0, plot.height - kAround);
  constexpr std::size_t kWidest = 40;  // letters: a wider margin would leave no plot
  std::size_t longest = 0;
  for (const Series& series : plot.series) longest = std::max(longest, series.label.size());
  longest = std::min(longest, kWidest);
  std::string script = "set rmargin " + std::to_string(longest + 5) + "\n";
  for (const EndLabel& label : end_labels(plot, step)) {
    const std::string color = series_color(plot, label.series);
    script += "set arrow from graph 1," + gnuplot::number(label.reaches ? label.end : label.at) +
              " to graph " + gnuplot::number(1 + kLeader) + "," + gnuplot::number(label.at) +
              " nohead lw 1.2 lc rgb '" + color + "'\nset label " +
              gnuplot::label_text(plot.series[label.series].label) + " at graph " +
              gnuplot::number(1 + kLeader + kAir) + "," + gnuplot::number(label.at) +
              " left font ',14' textcolor rgb '" + color + "'\n";
  }
  return script;
}

size_t column_named(const std::vector<std::string>& names, const std::string& wanted,
                    const std::string& attempt) {
  std::string all;
  for (size_t i = 0; i < names.size(); ++i) {
    if (names[i] == wanted || names[i].substr(0, names[i].find(" [")) == wanted) return i;
    all += (i ? ", " : "") + names[i];
  }
  throw Error::invalid_input(fmt::format("{}: no column \"{}\"; there are: {}", attempt, wanted, all));
}

double cell_number(const std::string& cell, const std::string& attempt, int line) {
  if (cell.empty()) return std::numeric_limits<double>::quiet_NaN();
  char* end = nullptr;
  const double value = std::strtod(cell.c_str(), &end);
  if (*end != '\0')
    throw Error::invalid_input(fmt::format("{}:{}: \"{}\" is no number", attempt, line, cell));
  return value;
}

}  // namespace

SiPrefix si_prefix(double value) {
  static constexpr SiPrefix kAll[] = {{"M", 1e6},  {"k", 1e3},  {"", 1},     {"m", 1e-3},
                                      {"µ", 1e-6}, {"n", 1e-9}, {"p", 1e-12}};
  constexpr double kRounded = 0.9995;  // 999.6 of a prefix is 1 of the next
  for (const SiPrefix& si : kAll)
    if (std::abs(value) >= kRounded * si.factor) return si;
  return value == 0 ? SiPrefix{} : kAll[std::size(kAll) - 1];
}

Series series_from_csv(const std::filesystem::path& csv, const std::string& x, const std::string& y,
                       const std::string& label) {
  const std::string attempt = "reading " + csv.string();
  const Table table = table_in(file_named(csv, attempt), csv.string());
  if (table.head.empty()) throw Error::invalid_input(attempt + ": the file is empty");
  const size_t x_column = column_named(table.head, x, attempt),
               y_column = column_named(table.head, y, attempt);
  Series series{.label = label, .x = {}, .y = {}};
  for (size_t r = 0; r < table.rows.size(); ++r) {
    series.x.push_back(cell_number(table.rows[r][x_column], attempt, table.lines[r]));
    series.y.push_back(cell_number(table.rows[r][y_column], attempt, table.lines[r]));
  }
  return series;
}

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

std::string key_corner(const Plot& plot) {
  constexpr double kWidth = 0.42, kLine = 0.08;  // of a key, and a line's height, over the plot's
  const auto lines = std::ranges::count_if(plot.series, [](const Series& s) { return !s.label.empty(); });
  const std::vector<Eigen::Vector2d> points = drawn_points(plot);
  struct Corner {
    const char* name;
    bool right, top;
  };
  std::string best;
  std::ptrdiff_t fewest = 0;
  for (const Corner& corner : {Corner{"right bottom", true, false}, Corner{"right top", true, true},
                               Corner{"left top", false, true}, Corner{"left bottom", false, false}}) {
    const auto covered = std::ranges::count_if(points, [&](const Eigen::Vector2d& p) {
      const double inwards = corner.right ? 1 - p.x() : p.x(), away = corner.top ? 1 - p.y() : p.y();
      return inwards < kWidth && away < kLine * static_cast<double>(lines);
    });
    if (best.empty() || covered < fewest) best = corner.name, fewest = covered;
  }
  return best;
}

Series bar_errors(const std::vector<double>& values, const std::vector<double>& errors) {
  Series series{"", {}, {}, Series::Style::line, "#222222", 2};
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!std::isfinite(errors[i])) continue;
    series.add(static_cast<double>(i), values[i] - errors[i]);
    series.add(static_cast<double>(i), values[i] + errors[i]);
    series.add(static_cast<double>(i), std::numeric_limits<double>::quiet_NaN());
  }
  return series;
}

void write_plot(const std::filesystem::path& base, const Plot& drawn) {
  Plot plot = drawn;
  constexpr double kAir = 0.04;
  gnuplot::require_drawable(base, plot.series);
  prefix(plot, plot.x, &Series::x, &Mark::x);
  prefix(plot, plot.y, &Series::y, &Mark::y);
  plot.x = limited(plot.x, plot.series, &Series::x);
  plot.y = limited(plot.y, plot.series, &Series::y);
  plot.y = not_stretched(plot.y, plot.series, &Series::y);
  std::string labels;
  if (has_end_labels(plot)) {
    plot.x = bounded(plot.x, plot.series, &Series::x, 0);
    plot.y = bounded(plot.y, plot.series, &Series::y, kAir);
    if (plot.x.low == plot.x.high) plot.x = bounded({plot.x.label}, plot.series, &Series::x, kAir);
    labels = end_label_commands(plot);
  }
  gnuplot::write_both(base, plot.width, plot.height,
                      gnuplot::data_blocks(plot.series) + frame_commands(plot) + labels,
                      gnuplot::plot_command(plot.series));
}

}  // namespace hysteron::render
