// The strip's loop over the law's, what separates them, and pictures, on one page.
#include <algorithm>
#include <cmath>

#include "experiments/kes/strip_output.h"
#include "render/plot.h"

namespace hysteron::experiments {
namespace {

constexpr const char* kLawAloneColor = "#C8C8C8";
constexpr const char* kStripColor = "#0072B2";
constexpr int kPlotWidth = 1100, kLoopHeight = 700, kDifferenceHeight = 400;  // [pixels]
constexpr int kPictureWidth = 640, kGap = 16;                                 // at most

render::Series series(const StripResult& strip, const std::vector<double>& values, double factor) {
  render::Series result{.label = "", .x = {}, .y = {}, .color = kStripColor, .line_width = 1.6};
  for (std::size_t i = 0; i < values.size(); ++i) {
    result.x.push_back(strip.walk.rows[i].curvature);
    result.y.push_back(factor * values[i]);
  }
  return result;
}

render::Plot loops(const StripTitle& title, const StripResult& strip) {
  render::Plot plot{
      .title = "KES-FB2 on a strip: " + title.fabric + ", law " + title.law + ", element " + strip.element,
      .x = {"curvature [1/m]"},
      .y = {"moment per width [mN]"}};
  plot.width = kPlotWidth, plot.height = kLoopHeight;
  plot.axes_at_zero = plot.key_inside = true;
  plot.series = {series(strip, strip.test.law_moment, kMilli), series(strip, strip.test.moment, kMilli)};
  plot.series[0].label = "law alone", plot.series[0].color = kLawAloneColor, plot.series[0].line_width = 7;
  plot.series[1].label = "strip, " + strip.mesh;
  for (const StripPicture& p : strip.pictures)
    plot.marks.push_back({p.letter, p.curvature, kMilli * p.moment, -1.2, p.curvature < 0 ? -0.3 : 0.6});
  return plot;
}

render::Plot differences(const StripResult& strip) {
  const StripTest& test = strip.test;
  render::Plot plot{.title = "Strip minus law with a cloth's memory, over its largest moment",
                    .x = {"curvature [1/m]"},
                    .y = {"difference [%]"}};
  plot.width = kPlotWidth, plot.height = kDifferenceHeight;
  plot.axes_at_zero = plot.key_inside = true;
  double moment = 0;
  for (double m : test.law_moment) moment = std::max(moment, std::abs(m));
  std::vector<double> difference = test.moment;
  for (std::size_t k = 0; k < difference.size(); ++k) difference[k] -= test.law_moment[k];
  plot.series = {series(strip, difference, 100 / moment)};
  return plot;
}

// Plots on the left, pictures in two columns on the right.
render::Image page(const render::Image& loop, const render::Image& difference,
                   const std::vector<StripPicture>& pictures) {
  const int height = loop.height() + difference.height();
  const int rows = static_cast<int>(pictures.size() + 1) / 2, cell = height / rows;
  const render::Image& first = pictures.front().image;  // all are equally large
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

void write_strip_figures(Run& run, const std::string& ending, const StripTitle& title,
                         const StripResult& strip) {
  const std::string loop = "plot_strip" + ending, difference = "plot_strip_difference" + ending;
  run.plot(loop, loops(title, strip));
  run.plot(difference, differences(strip));
  run.finish_plots();
  const std::filesystem::path loop_file = run.folder() / (loop + ".png"),
                              difference_file = run.folder() / (difference + ".png");
  if (!exists(loop_file) || !exists(difference_file) || strip.pictures.empty()) return;
  write_png(run.path("strip" + ending + ".png"),
            page(render::read_png(loop_file), render::read_png(difference_file), strip.pictures),
            render::PngEffort::best);
}

}  // namespace hysteron::experiments
