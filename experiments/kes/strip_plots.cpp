// The strips' loops over the law's, what separates them, and pictures, on one page.
#include <algorithm>
#include <cmath>

#include "experiments/kes/strip_output.h"
#include "render/plot.h"

namespace hysteron::experiments {
namespace {

constexpr const char* kLawAloneColor = "#C8C8C8";
constexpr const char* kColors[] = {"#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9"};
constexpr int kPlotWidth = 1100, kLoopHeight = 700, kDifferenceHeight = 400;  // [pixels]
constexpr int kPictureWidth = 640, kGap = 16;                                 // at most

std::vector<const StripResult*> found(const std::vector<StripResult>& strips) {
  std::vector<const StripResult*> result;
  for (const StripResult& strip : strips)
    if (strip.failure.empty()) result.push_back(&strip);
  return result;
}

render::Series series(const StripResult& strip, const std::vector<double>& values, double factor) {
  render::Series result{.label = "", .x = {}, .y = {}};
  for (std::size_t i = 0; i < values.size(); ++i) {
    result.x.push_back(strip.walk.rows[i].curvature);
    result.y.push_back(factor * values[i]);
  }
  return result;
}

render::Plot loops(const StripTitle& title, const std::vector<const StripResult*>& strips) {
  render::Plot plot{.title = "KES-FB2 on a strip: " + title.fabric + ", law " + title.law + ", element " +
                             strips[0]->element,
                    .x = {"curvature [1/m]"},
                    .y = {"moment per width [mN]"}};
  plot.width = kPlotWidth, plot.height = kLoopHeight;
  plot.axes_at_zero = plot.key_inside = true;
  plot.series.push_back(series(*strips[0], strips[0]->test.law_moment, kMilli));
  plot.series[0].label = "law alone", plot.series[0].color = kLawAloneColor, plot.series[0].line_width = 7;
  for (std::size_t i = 0; i < strips.size(); ++i) {
    plot.series.push_back(series(*strips[i], strips[i]->test.moment, kMilli));
    plot.series.back().label = "strip, " + strips[i]->mesh;
    plot.series.back().color = kColors[i % std::size(kColors)];
    plot.series.back().line_width = 1.6;
  }
  if (strips.size() == 1)
    for (const StripPicture& p : strips[0]->pictures)
      plot.marks.push_back({p.letter, p.curvature, kMilli * p.moment, -1.2, p.curvature < 0 ? -0.3 : 0.6});
  return plot;
}

render::Plot differences(const std::vector<const StripResult*>& strips) {
  render::Plot plot{.title = "Strip minus law with a cloth's memory, over its largest moment",
                    .x = {"curvature [1/m]"},
                    .y = {"difference [%]"}};
  plot.width = kPlotWidth, plot.height = kDifferenceHeight;
  plot.axes_at_zero = plot.key_inside = true;
  double moment = 0;
  for (double m : strips[0]->test.law_moment) moment = std::max(moment, std::abs(m));
  for (std::size_t i = 0; i < strips.size(); ++i) {
    std::vector<double> difference = strips[i]->test.moment;
    for (std::size_t k = 0; k < difference.size(); ++k) difference[k] -= strips[i]->test.law_moment[k];
    plot.series.push_back(series(*strips[i], difference, 100 / moment));
    plot.series.back().color = kColors[i % std::size(kColors)];
    plot.series.back().line_width = 1.6;
  }
  return plot;
}

// All pictures of one strip, or of several each at the amplitude.
std::vector<render::Image> chosen_pictures(const std::vector<const StripResult*>& strips) {
  std::vector<render::Image> images;
  if (strips.size() == 1)
    for (const StripPicture& p : strips[0]->pictures) images.push_back(p.image);
  else
    for (const StripResult* strip : strips)
      if (strip->pictures.size() > 1) images.push_back(strip->pictures[1].image);
  return images;
}

// Plots on the left, pictures in two columns on the right.
render::Image page(const render::Image& loop, const render::Image& difference,
                   const std::vector<render::Image>& pictures) {
  const int height = loop.height() + difference.height();
  const int rows = static_cast<int>(pictures.size() + 1) / 2, cell = height / rows;
  const render::Image& first = pictures.front();  // all are equally large
  const double scale = std::min(static_cast<double>(kPictureWidth) / first.width(),
                                static_cast<double>(cell - kGap) / first.height());
  const int wide = static_cast<int>(scale * first.width()), high = static_cast<int>(scale * first.height());
  render::Image page(loop.width() + 2 * (wide + kGap), height, render::Rgb8{255, 255, 255});
  paste(page, loop, 0, 0);
  paste(page, difference, 0, loop.height());
  for (int i = 0; i < static_cast<int>(pictures.size()); ++i)
    paste(page, shrink(pictures[i], wide, high), loop.width() + i % 2 * (wide + kGap),
          i / 2 * cell + (cell - high) / 2);
  return page;
}

}  // namespace

void write_strip_figures(Run& run, const std::string& ending, const StripTitle& title,
                         const std::vector<StripResult>& strips) {
  const std::vector<const StripResult*> shown = found(strips);
  if (shown.empty()) return;
  render::Image loop, difference;
  const auto draw = [&](const std::string& name, const render::Plot& plot, render::Image& image) {
    run.plot(name + ending, [&](const std::filesystem::path& base) {
      render::write_plot(base, plot);
      image = render::read_png(base.string() + ".png");
    });
  };
  draw("plot_strip", loops(title, shown), loop);
  draw("plot_strip_difference", differences(shown), difference);
  const std::vector<render::Image> pictures = chosen_pictures(shown);
  if (loop.empty() || difference.empty() || pictures.empty()) return;
  write_png(run.path("strip" + ending + ".png"), page(loop, difference, pictures), render::PngEffort::best);
}

}  // namespace hysteron::experiments
