#include "experiments/kes/output.h"

#include <algorithm>
#include <cmath>

#include "experiments/workbench/app/law_family.h"
#include "render/color_map.h"
#include "render/plot.h"
#include "sim/base/csv.h"

namespace hysteron::experiments {
namespace {

// Readings below this share of what the largest moment could give count as zero.
constexpr double kNothing = 1e-4;

double largest(const std::vector<double>& values) {
  double result = 0;
  for (double value : values) result = std::max(result, std::abs(value));
  return result;
}

// Returns the mean curvature between the clamps relative to the nominal one at the amplitude [%].
double bend_between(const StripResult& result) {
  if (result.test.free_curvature.empty()) return NAN;
  const std::size_t row = result.strip.walk.start[1];
  return 100 * (result.test.free_curvature[row] / result.strip.walk.rows[row].curvature - 1);
}

void write_strip_readings(Run& run, const std::string& p, const StripResult& result,
                          const StripDifference& d) {
  const StripTest& test = result.test;
  run.metric(p + "strip_B_N_m", test.reading.rigidity);
  run.metric(p + "strip_2HB_N", test.reading.loop_width);
  run.metric(p + "strip_residual_curvature_per_m", test.reading.residual);
  run.metric(p + "strip_loop_area_J_per_m2", test.reading.loop_area);
  run.metric(p + "strip_B_difference_percent", d.rigidity);
  run.metric(p + "strip_2HB_difference_percent", d.loop_width);
  run.metric(p + "strip_residual_difference_percent", d.residual);
  run.metric(p + "strip_loop_area_difference_percent", d.loop_area);
  run.metric(p + "strip_largest_moment_difference_percent", 100 * largest_difference(test));
  run.metric(p + "strip_free_curvature_difference_percent", bend_between(result));
  run.metric(p + "strip_largest_clamp_force_N_per_m", test.largest_force);
  run.metric(p + "strip_triangles_count", result.strip.cloth.mesh.faces());
  run.metric(p + "strip_spacing_m", result.strip.spacing);
  run.metric(p + "strip_equilibria_count", result.strip.walk.rows.size() - 1);
  run.metric(p + "strip_newton_iterations_per_step", test.newton_iterations);
  run.metric(p + "strip_retried_steps_count", test.retried_steps);
  run.metric(p + "strip_solve_s", test.seconds);
}

// ---- one page with the loop over the law's, their difference, and pictures ----

constexpr const char* kLawAloneColor = "#C8C8C8";
constexpr const char* kStripColor = "#0072B2";
constexpr int kPlotWidth = 1100, kLoopHeight = 700, kDifferenceHeight = 400;  // [pixels]
constexpr int kPictureWidth = 640, kGap = 16;                                 // largest sizes [pixels]

render::Series series(const StripResult& result, const std::vector<double>& values, double factor) {
  render::Series series{.label = "", .x = {}, .y = {}, .color = kStripColor, .line_width = 1.6};
  for (std::size_t i = 0; i < values.size(); ++i) {
    series.add(result.strip.walk.rows[i].curvature, factor * values[i]);
  }
  return series;
}

render::Plot loops(const StripResult& result) {
  const Scene& scene = result.strip.scene;
  render::Plot plot{.title = "KES-FB2 on a strip: " + scene.fabric.name + ", law " + scene.law +
                             ", element " + enum_name(scene.element),
                    .x = {"curvature [1/m]"},
                    .y = {"moment per width [mN]"}};
  plot.width = kPlotWidth, plot.height = kLoopHeight;
  plot.axes_at_zero = plot.key_inside = true;
  plot.series = {series(result, result.test.law_moment, kMilli), series(result, result.test.moment, kMilli)};
  plot.series[0].label = "law alone, computed", plot.series[0].color = kLawAloneColor,
  plot.series[0].line_width = 7;
  plot.series[1].label = "strip, simulated", plot.series[1].color = render::hex(color_of_law(scene.law));
  for (const StripPicture& p : result.pictures)
    plot.marks.push_back({p.letter, p.curvature, kMilli * p.moment, -1.2, p.curvature < 0 ? -0.3 : 0.6});
  return plot;
}

render::Plot differences(const StripResult& result) {
  const StripTest& test = result.test;
  render::Plot plot{.title = "Strip minus law with a cloth's memory, over its largest moment",
                    .x = {"curvature [1/m]"},
                    .y = {"difference [%]"}};
  plot.width = kPlotWidth, plot.height = kDifferenceHeight;
  plot.axes_at_zero = plot.key_inside = true;
  std::vector<double> difference = test.moment;
  for (std::size_t k = 0; k < difference.size(); ++k) difference[k] -= test.law_moment[k];
  plot.series = {series(result, difference, 100 / largest(test.law_moment))};
  return plot;
}

// Composes the plots on the left and the pictures in two columns on the right.
render::Image page(const render::Image& loop, const render::Image& difference,
                   const std::vector<StripPicture>& pictures) {
  const int height = loop.height() + difference.height();
  const int rows = static_cast<int>(pictures.size() + 1) / 2, cell = height / rows;
  const render::Image& first = pictures.front().image;  // all have the same size
  const double scale = std::min(static_cast<double>(kPictureWidth) / first.width(),
                                static_cast<double>(cell - kGap) / first.height());
  const int wide = static_cast<int>(scale * first.width()), high = static_cast<int>(scale * first.height());
  render::Image page(loop.width() + 2 * (wide + kGap), height, render::Rgb8{255, 255, 255});
  paste(page, loop, 0, 0);
  paste(page, difference, 0, loop.height());
  for (int i = 0; i < static_cast<int>(pictures.size()); ++i)
    paste(page, shrink(pictures[i].image, wide, high), loop.width() + i % 2 * (wide + kGap),
          i / 2 * cell + (cell - high) / 2);
  return page;
}

}  // namespace

StripDifference difference(const StripTest& strip, double amplitude) {
  const double moment = largest(strip.law_moment);
  const auto difference_percent = [](double a, double b, double scale) {
    return std::abs(b) > kNothing * scale ? 100 * (a / b - 1) : NAN;
  };
  const KesReading &own = strip.reading, &law = strip.law_reading;
  return {difference_percent(own.rigidity, law.rigidity, moment / amplitude),
          difference_percent(own.loop_width, law.loop_width, 2 * moment),
          difference_percent(own.residual, law.residual, amplitude),
          difference_percent(own.loop_area, law.loop_area, 4 * moment * amplitude)};
}

void write_strip_metrics(Run& run, const std::string& prefix, double amplitude, const StripResult& result) {
  if (!result.renderer.empty()) run.manifest().renderer = result.renderer;
  if (result.failure.empty())
    write_strip_readings(run, prefix, result, difference(result.test, amplitude));
  else
    run.metric(prefix + "strip_failure", result.failure);
}

void write_strip_table(Run& run, const std::string& ending, const StripResult& result) {
  const std::string& mesh = result.strip.scene.mesh;
  std::vector<Column> columns = {{"curvature [1/m]", {}},
                                 {"law moment [N]", result.test.law_moment},
                                 {mesh + " moment [N]", result.test.moment}};
  for (const LawRow& row : result.strip.walk.rows) columns[0].values.push_back(row.curvature);
  if (!result.test.free_curvature.empty())
    columns.push_back({mesh + " free curvature [1/m]", result.test.free_curvature});
  Table(columns).write(run.path("strip" + ending + ".csv"));
}

void write_strip_figures(Run& run, const std::string& ending, const StripResult& result) {
  const std::string loop = "plot_strip" + ending, difference = "plot_strip_difference" + ending;
  run.plot(loop, loops(result));
  run.plot(difference, differences(result));
  run.finish_plots();
  const std::filesystem::path loop_file = run.folder() / (loop + ".png"),
                              difference_file = run.folder() / (difference + ".png");
  if (!exists(loop_file) || !exists(difference_file) || result.pictures.empty()) return;
  write_png(run.path("strip" + ending + ".png"),
            page(render::read_png(loop_file), render::read_png(difference_file), result.pictures),
            render::PngEffort::best);
}

}  // namespace hysteron::experiments
