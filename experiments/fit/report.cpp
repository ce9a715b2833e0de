#include "experiments/fit/report.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "render/panels.h"
#include "sim/base/csv.h"
#include "sim/base/number_in.h"
#include "sim/scene/key_table.h"

namespace hysteron::experiments {
namespace {

struct Row {
  const char* metric;
  const char* name;
  const char* unit;
  const Estimate* estimate;
};

std::vector<Row> result_rows(const Identification& found) {
  return {{"b1_N_m", "b1", "N m", &found.b1},
          {"b2_N_m", "b2", "N m", &found.b2},
          {"k0_per_m", "k0", "1/m", &found.k0}};
}

void add_metrics(Run& run, const Identification& found, const std::string& prefix) {
  for (const Row& row : result_rows(found)) {
    run.metric(prefix + row.metric, row.estimate->value);
    run.metric(prefix + row.metric + "_stderr", row.estimate->standard_error);
  }
  run.metric(prefix + "undetermined", found.undetermined());
  run.metric(prefix + "2HB_N", 2 * found.curve().friction_moment());
  run.metric(prefix + "residual_rms_N", found.residual_rms());
  run.metric(prefix + "residual_rms_percent", 100 * found.residual_rms() / found.largest_moment());
  run.metric(prefix + "iterations", found.iterations);
  for (const auto& [name, value] : found.further) run.metric(prefix + name, value);
}

void write_rows(Run& run, const std::vector<Identification>& fits) {
  std::vector<Column> columns = {{"curvature [1/m]", fits[0].curvature}, {"moment [N]", fits[0].moment}};
  for (const Identification& fit : fits) {
    const std::string law = fits.size() > 1 ? "_" + fit.law : "";
    Column residual{"residual" + law + " [N]", fit.moment};
    for (std::size_t i = 0; i < fit.model.size(); ++i) residual.values[i] -= fit.model[i];
    columns.push_back({"model" + law + " [N]", fit.model});
    columns.push_back(residual);
  }
  Table(columns).write(run.path("fit.csv"));
}

std::string percent_text(const Identification& fit) {
  return number_text(100 * fit.residual_rms() / fit.largest_moment(), 2, "%");
}

std::string with_error(const Row& row) {
  const Estimate& e = *row.estimate;
  const std::string error = e.standard_error > 0 && std::isfinite(e.standard_error)
                                ? fmt::format(" +- {:.2g}", e.standard_error)
                                : "";
  const std::string exact = e.standard_error == 0 ? " (taken as exact)" : "";
  return fmt::format("  {} = {:.4g}{} {}{}{}\n", row.name, e.value, error, row.unit, exact,
                     e.determined ? "" : "  (" + e.confidence + "; the data do not determine it)");
}

std::string fit_summary(const Identification& found) {
  std::string text = found.law + ": residual " + percent_text(found) + " of the largest moment (rms), " +
                     std::to_string(found.moment.size()) + " rows, " + std::to_string(found.iterations) +
                     " iterations\n";
  for (const Row& row : result_rows(found)) text += with_error(row);
  const std::vector<std::string> open = found.undetermined();
  text += "  undetermined: " + (open.empty() ? std::string("nothing") : join(open, ", ")) + "\n";
  for (const std::string& statement : found.statements) text += "  - " + statement + "\n";
  return text;
}

// ---- data beside the law, and the law's residuals ----

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

// Returns an axis around the values, and around zero if they have both signs.
render::Axis axis(const std::string& label, const std::vector<double>& values) {
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  const double top = kHeadroom * largest(values), below = *low < -0.2 * *high ? -top : -0.04 * top;
  return top > 0 ? render::Axis{label, false, below, top} : render::Axis{label};
}

std::string share_text(const Identification& fit) {
  return fmt::format("rms {:.3g} %", 100 * fit.residual_rms() / fit.largest_moment());
}

// Returns the data and the law's curve in their order, from the virgin state if that comes first.
std::vector<render::Series> curves(const Identification& fit) {
  return {{"data", fit.curvature, milli(fit.moment), Style::points, kDataColor},
          {fit.law + ", " + share_text(fit), fit.curvature, milli(fit.model), Style::line, kLawColor, 1.8}};
}

// Returns the residuals and a frame of one rms above and below zero.
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

// Draws one panel a law, the best first, on common axes.
void draw_panels(Run& run, const std::vector<Identification>& fits, const std::string& title) {
  render::Panels data{"Bending of " + title, "dots: data; line: the law", {}, {}, {}};
  render::Panels left{"Data minus law, " + title, "dashed: one rms", {}, {}, {}};
  std::vector<double> all_left;
  for (const Identification& fit : fits) {
    const std::vector<double> fit_residuals = milli(left_over(fit));
    all_left.insert(all_left.end(), fit_residuals.begin(), fit_residuals.end());
    const std::vector<std::string> numbers = {"b1 " + number_text(1e6 * fit.b1.value, 4) + " µN m",
                                              "b2 " + number_text(1e6 * fit.b2.value, 4) + " µN m",
                                              "k0 " + number_text(fit.k0.value, 4) + " /m"};
    data.panels.push_back({fit.law + ", " + share_text(fit), curves(fit), numbers, {}});
    left.panels.push_back({fit.law + ", " + share_text(fit), residuals(fit), {}, {}});
  }
  data.x = left.x = axis("curvature [1/m]", fits[0].curvature);
  data.y = axis("moment per width [mN]", milli(fits[0].moment));
  left.y = axis("residual [mN]", all_left);
  data.columns = left.columns = static_cast<int>(fits.size() > 4 ? (fits.size() + 2) / 3 : fits.size());
  run.plot("plot_fit", data, render::write_panels);
  run.plot("plot_residual", left, render::write_panels);
}

// Draws plot_fit and plot_residual, with a panel for each of several laws.
void draw_fits(Run& run, const std::vector<Identification>& fits, const std::string& title) {
  if (fits.size() == 1) {
    draw_one(run, fits[0], title);
  } else {
    draw_panels(run, fits, title);
  }
}

}  // namespace

void report_fits(Run& run, const std::vector<Identification>& fits, const FabricNotes& notes) {
  write_fabric(run.path("fabric.toml"), fits[0], notes);
  write_rows(run, fits);
  const bool several = fits.size() > 1;
  if (several) run.metric("best_law", fits[0].law);
  for (const Identification& fit : fits) add_metrics(run, fit, several ? fit.law + "." : "");
  for (const Identification& fit : fits) run.manifest().statements.push_back({fit.law, fit.statements});
  draw_fits(run, fits, notes.name + ": " + notes.from);
}

std::string summary(const std::vector<Identification>& fits) {
  std::string text;
  for (const Identification& fit : fits) {
    if (fits.size() == 1) break;
    const std::vector<std::string> open = fit.undetermined();
    text += fit.law + ": rms " + percent_text(fit) + "; b1 " + number_text(fit.b1.value, 4) + ", b2 " +
            number_text(fit.b2.value, 4) + " N m, k0 " + number_text(fit.k0.value, 4) + "/m" +
            (open.empty() ? "" : "; undetermined: " + join(open, ", ")) + "\n";
  }
  return text + fit_summary(fits[0]);
}

}  // namespace hysteron::experiments
