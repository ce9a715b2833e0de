#include "experiments/crease/protractor.h"

#include <fmt/core.h>

#include <cmath>
#include <numbers>

#include "experiments/workbench/compare/column_view.h"
#include "render/color_map.h"
#include "render/plot_page.h"
#include "sim/base/csv.h"

namespace hysteron::experiments {
namespace {

constexpr const char *kProfile = "profile.csv", *kLimbs = "limbs.csv";
constexpr double kMillimetres = 1e3;

using Eigen::Vector2d;
using Style = render::Series::Style;

Vector2d in_profile(const Eigen::Vector3d& point) { return {point.x(), point.z()}; }

// Returns where the lines through both limbs meet; if they are nearly parallel, the middle between their
// inner ends.
Vector2d apex(const Limbs& limbs) {
  constexpr double kParallel = 0.05;  // sine of the angle between them
  const Vector2d p = in_profile(limbs.near.inner), d = in_profile(limbs.near.direction()),
                 q = in_profile(limbs.far.inner), e = in_profile(limbs.far.direction());
  const double across = d.x() * e.y() - d.y() * e.x();
  if (std::abs(across) < kParallel) return (p + q) / 2;
  const Vector2d between = q - p;
  return p + (between.x() * e.y() - between.y() * e.x()) / across * d;
}

double heading(const Eigen::Vector3d& direction) { return std::atan2(direction.z(), direction.x()); }

// From the far limb by the smaller way to the near one, at that distance from the apex.
struct Arc {
  Vector2d middle;
  double radius, from, turn;  // [mm], [rad]

  Vector2d at(double share) const {
    const double angle = from + share * turn;
    return middle + radius * Vector2d(std::cos(angle), std::sin(angle));
  }
};

Arc arc_between(const Limbs& limbs, double radius) {
  const double from = heading(limbs.far.direction());
  const double turn = std::remainder(heading(limbs.near.direction()) - from, 2 * std::numbers::pi);
  return {apex(limbs), radius, from, turn};
}

void add_protractor(const CreasedStrip& strip, double radius, render::Plot& plot) {
  constexpr double kThin = 1.2;
  const Arc arc = arc_between(strip.limbs, radius);
  render::Series lines{"", {}, {}, Style::dashed, strip.color, kThin};
  for (const Vector2d& point :
       {in_profile(strip.limbs.near.outer), arc.middle, in_profile(strip.limbs.far.outer)})
    lines.add(point.x(), point.y());
  render::Series bow{"", {}, {}, Style::line, strip.color, kThin};
  constexpr int kParts = 60;
  for (int i = 0; i <= kParts; ++i) {
    const Vector2d point = arc.at(static_cast<double>(i) / kParts);
    bow.add(point.x(), point.y());
  }
  plot.series.push_back(lines);
  plot.series.push_back(bow);
  plot.marks.push_back({fmt::format("{} {:.0f}°", strip.name, strip.limbs.opening()), strip.x.back(),
                        strip.z.back(), 0.8, 0.3, strip.color, false});
}

double extent(const CreasedStrip& strip) {
  const auto [low, high] = std::minmax_element(strip.x.begin(), strip.x.end());
  return *high - *low;
}

// Lengths as the run has written them.
Limbs limbs_in(const std::filesystem::path& file) {
  const render::Series points = render::series_from_csv(file, "x", "z", "");
  const auto at = [&](std::size_t i) { return Eigen::Vector3d(points.x.at(i), 0, points.y.at(i)); };
  return {{at(0), at(1)}, {at(2), at(3)}};
}

// Moment against curvature of all columns that are probed.
render::Plot loops_plot(const std::vector<ChildRun>& columns, const std::vector<CreasedStrip>& strips,
                        const std::vector<std::size_t>& shown) {
  render::Plot plot{"in the crease", {"curvature [1/m]"}, {"moment per width [mN]"}};
  plot.axes_at_zero = true;
  const ProbedLoops loops(columns);
  for (std::size_t i = 0; i < shown.size(); ++i) {
    const render::Path path = loops.at(shown[i], INFINITY).path;
    if (path.curvature.empty()) continue;
    render::Series series{strips[i].name, path.curvature, path.moment, Style::line, strips[i].color};
    for (double& moment : series.y) moment *= 1e3;
    plot.series.push_back(series);
  }
  return plot;
}

}  // namespace

CreasedStrip creased_strip(const std::string& name, const std::string& color, const Crease& crease,
                           const std::vector<Eigen::Vector3d>& positions) {
  CreasedStrip strip{name, color, {}, {}, crease.limbs(positions)};
  for (const Eigen::Vector3d& point : crease.profile(positions)) {
    strip.x.push_back(kMillimetres * point.x());
    strip.z.push_back(kMillimetres * point.z());
  }
  for (Limb* limb : {&strip.limbs.near, &strip.limbs.far})
    for (Eigen::Vector3d* point : {&limb->inner, &limb->outer})
      *point = kMillimetres * Eigen::Vector3d(point->x(), 0, point->z());
  return strip;
}

render::Plot protractor_plot(const std::string& title, const std::vector<CreasedStrip>& strips) {
  constexpr double kArc = 0.2,
                   kApart = 0.07;  // radius of the first arc and between arcs, of the profile's width
  render::Plot plot{title, {"x [mm]"}, {"height [mm]"}};
  plot.equal_scales = true;
  constexpr double kNamed = 1.5;  // the part of the plot on the right is left to the names at the ends
  double width = 0, rightmost = 0;
  for (const CreasedStrip& strip : strips) {
    width = std::max(width, extent(strip));
    rightmost = std::max(rightmost, *std::max_element(strip.x.begin(), strip.x.end()));
  }
  double radius = kArc * width;
  for (const CreasedStrip& strip : strips) {
    add_protractor(strip, radius, plot);
    radius += kApart * width;
  }
  plot.x.high = kNamed * rightmost;
  for (const CreasedStrip& strip : strips)
    plot.series.push_back({"", strip.x, strip.z, Style::line, strip.color, 5});
  return plot;
}

void write_profile(Run& run, const CreasedStrip& strip) {
  Table profile(std::vector<std::string>{"point", "x [mm]", "z [mm]"});
  for (std::size_t i = 0; i < strip.x.size(); ++i)
    profile.row({static_cast<double>(i), strip.x[i], strip.z[i]});
  profile.write(run.path(kProfile));
  Table limbs(std::vector<std::string>{"point", "x [mm]", "z [mm]"});
  double i = 0;
  for (const Limb& limb : {strip.limbs.near, strip.limbs.far})
    for (const Eigen::Vector3d& point : {limb.inner, limb.outer}) limbs.row({i++, point.x(), point.z()});
  limbs.write(run.path(kLimbs));
}

void plot_protractor(Run& run, const ComparisonPage& page, const std::vector<ChildRun>& columns) {
  const std::vector<std::string> names = column_names(columns, page.names);
  const std::vector<render::Rgb8> colors = column_colors(columns);
  std::vector<CreasedStrip> strips;
  std::vector<std::size_t> shown;
  for (std::size_t c = 0; c < columns.size(); ++c) {
    const auto profile = columns[c].folder / kProfile;
    if (!std::filesystem::exists(profile)) continue;
    const render::Series middle = render::series_from_csv(profile, "x", "z", "");
    strips.push_back(
        {names[c], render::hex(colors[c]), middle.x, middle.y, limbs_in(columns[c].folder / kLimbs)});
    shown.push_back(c);
  }
  if (strips.empty()) return;
  render::PlotPage panels{
      page.title + ": angle between the limbs at the end", "simulated; seen along the crease", {}};
  panels.plots.push_back({protractor_plot("", strips), "off"});
  if (render::Plot loops = loops_plot(columns, strips, shown); !loops.series.empty())
    panels.plots.push_back({std::move(loops), "bottom right"});
  run.plot("plot_protractor", panels, render::write_plot_page);
}

}  // namespace hysteron::experiments
