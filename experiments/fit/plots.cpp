// Data beside the law, and what the law leaves of them.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "experiments/fit/report.h"
#include "render/panels.h"

namespace hysteron::experiments {
namespace {

using Style = render::Series::Style;
constexpr const char* kDataColor = "#9FB6C8";
constexpr const char* kLawColor = "#D55E00";
constexpr const char* kFrameColor = "#444444";
constexpr double kHeadroom = 1.08;

std::vector<double> milli(std::vector<double> values) {
  for (double& value : values) value *= 1e3;
  return values;
}

std::vector<double> left_over(const Identification& fit) {
  std::vector<double> left = fit.moment;
  for (std::size_t row = 0; row < left.size(); ++row) left[row] -= fit.model[row];
  return left;
}

double largest(const std::vector<double>& values) {
  double top = 0;
  for (const double value : values) top = std::max(top, std::abs(value));
  return top;
}

// Around the values, and around zero where they have both signs.
render::Axis axis(const std::string& label, const std::vector<double>& values) {
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  const double top = kHeadroom * largest(values), below = *low < -0.2 * *high ? -top : -0.04 * top;
  return top > 0 ? render::Axis{label, false, below, top} : render::Axis{label};
}

std::string share_text(const Identification& fit) {
  return fmt::format("rms {:.3g} %", 100 * fit.residual_rms() / fit.largest_moment());
}

// The law's curve in the order of the data, from the virgin state if that comes first.
std::vector<render::Series> curves(const Identification& fit) {
  return {{"data", fit.curvature, milli(fit.moment), Style::points, kDataColor},
          {fit.law + ", " + share_text(fit), fit.curvature, milli(fit.model), Style::line, kLawColor, 1.8}};
}

// The residuals and a frame of one rms above and below zero.
std::vector<render::Series> residuals(const Identification& fit) {
  const auto [low, high] = std::minmax_element(fit.curvature.begin(), fit.curvature.end());
  const double rms = 1e3 * fit.residual_rms();
  std::vector<render::Series> series = {
      {fit.law, fit.curvature, milli(left_over(fit)), Style::points, kLawColor}};
  for (const double level : {rms, -rms}) {
    series.push_back(
        {level > 0 ? "one rms" : "", {*low, *high}, {level, level}, Style::dashed, kFrameColor, 1});
  }
  return series;
}

void draw_one(Run& run, const Identification& fit, const std::string& title) {
  const render::Axis curvature = axis("curvature [1/m]", fit.curvature);
  const render::Plot data{"Bending of " + title, curvature, axis("moment per width [mN]", milli(fit.moment)),
                          curves(fit)};
  const render::Plot left{"Data minus law, " + title, curvature, axis("residual [mN]", milli(left_over(fit))),
                          residuals(fit)};
  run.plot("plot_fit", data);
  run.plot("plot_residual", left);
}

// One panel a law, the best first, on common axes.
void draw_panels(Run& run, const std::vector<Identification>& fits, const std::string& title) {
  render::Panels data{"Bending of " + title, "dots: data; line: the law", {}, {}, {}};
  render::Panels left{"Data minus law, " + title, "dashed: one rms", {}, {}, {}};
  std::vector<double> all_left;
  for (const Identification& fit : fits) {
    const std::vector<double> fit_residuals = milli(left_over(fit));
    all_left.insert(all_left.end(), fit_residuals.begin(), fit_residuals.end());
    const std::vector<std::string> numbers = {"b1 " + rounded(1e6 * fit.b1.value) + " µN m",
                                              "b2 " + rounded(1e6 * fit.b2.value) + " µN m",
                                              "k0 " + rounded(fit.k0.value) + " /m"};
    data.panels.push_back({fit.law + ", " + share_text(fit), curves(fit), numbers, {}});
    left.panels.push_back({fit.law + ", " + share_text(fit), residuals(fit), {}, {}});
  }
  data.x = left.x = axis("curvature [1/m]", fits[0].curvature);
  data.y = axis("moment per width [mN]", milli(fits[0].moment));
  left.y = axis("residual [mN]", all_left);
  data.columns = left.columns = static_cast<int>(fits.size() > 4 ? (fits.size() + 2) / 3 : fits.size());
  run.plot("plot_fit", [data](const std::filesystem::path& base) { render::write_panels(base, data); });
  run.plot("plot_residual", [left](const std::filesystem::path& base) { render::write_panels(base, left); });
}

}  // namespace

void draw_fits(Run& run, const std::vector<Identification>& fits, const std::string& title) {
  if (fits.size() == 1) {
    draw_one(run, fits[0], title);
  } else {
    draw_panels(run, fits, title);
  }
}

}  // namespace hysteron::experiments
