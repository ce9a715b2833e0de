#include "experiments/kes/strip_output.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "sim/base/csv.h"

namespace hysteron::experiments {
namespace {

constexpr double kNothing = 1e-4;  // of what the largest moment could make of a reading: the law reads zero

double largest(const std::vector<double>& values) {
  double result = 0;
  for (double value : values) result = std::max(result, std::abs(value));
  return result;
}

std::string percent(double value) { return std::isfinite(value) ? fmt::format("{:+.2f} %", value) : "-"; }

// Mean curvature between the clamps over that of the gauge, at the amplitude, minus 1 [percent].
double bend_between(const StripResult& strip) {
  if (strip.test.free_curvature.empty()) return NAN;
  const std::size_t row = strip.walk.start[1];
  return 100 * (strip.test.free_curvature[row] / strip.walk.rows[row].curvature - 1);
}

void write_strip_readings(Run& run, const std::string& p, const StripResult& strip,
                          const StripDifference& d) {
  const StripTest& test = strip.test;
  run.metric(p + "strip_B_N_m", test.reading.rigidity);
  run.metric(p + "strip_2HB_N", test.reading.loop_width);
  run.metric(p + "strip_residual_curvature_per_m", test.reading.residual);
  run.metric(p + "strip_loop_area_J_per_m2", test.reading.loop_area);
  run.metric(p + "strip_B_difference_percent", d.rigidity);
  run.metric(p + "strip_2HB_difference_percent", d.loop_width);
  run.metric(p + "strip_residual_difference_percent", d.residual);
  run.metric(p + "strip_loop_area_difference_percent", d.loop_area);
  run.metric(p + "strip_largest_moment_difference_percent", 100 * largest_difference(test));
  run.metric(p + "strip_free_curvature_difference_percent", bend_between(strip));
  run.metric(p + "strip_largest_clamp_force_N_per_m", test.largest_force);
  run.metric(p + "strip_triangles_count", strip.triangles);
  run.metric(p + "strip_spacing_m", strip.spacing);
  run.metric(p + "strip_equilibria_count", strip.walk.rows.size() - 1);
  run.metric(p + "strip_newton_iterations_per_step", test.newton_iterations);
  run.metric(p + "strip_retried_steps_count", test.retried_steps);
  run.metric(p + "strip_solve_s", test.seconds);
}

}  // namespace

std::string four_digits(double value) { return std::isfinite(value) ? fmt::format("{:.4g}", value) : "-"; }

void print_row(const std::string& name, const std::vector<std::string>& cells) {
  std::vector<std::string> row = {name};
  row.insert(row.end(), cells.begin(), cells.end());
  fmt::print("{}\n", aligned(row, {-19, 13}));
}

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

void write_strip_metrics(Run& run, const std::string& prefix, double amplitude,
                         const std::vector<StripResult>& strips) {
  for (const StripResult& strip : strips) {
    const std::string p = prefix + strip.prefix;
    if (!strip.renderer.empty()) run.manifest().renderer = strip.renderer;
    if (strip.failure.empty())
      write_strip_readings(run, p, strip, difference(strip.test, amplitude));
    else
      run.metric(p + "strip_failure", strip.failure);
  }
}

void write_strip_table(Run& run, const std::string& ending, const std::vector<StripResult>& strips) {
  std::vector<Column> columns;
  for (const StripResult& strip : strips) {
    if (!strip.failure.empty()) continue;
    if (columns.empty()) {
      columns = {{"curvature [1/m]", {}}, {"law moment [N]", strip.test.law_moment}};
      for (const LawRow& row : strip.walk.rows) columns[0].values.push_back(row.curvature);
    }
    columns.push_back({strip.mesh + " moment [N]", strip.test.moment});
    if (!strip.test.free_curvature.empty())
      columns.push_back({strip.mesh + " free curvature [1/m]", strip.test.free_curvature});
  }
  if (!columns.empty()) Table(columns).write(run.path("strip" + ending + ".csv"));
}

void print_strips(double amplitude, const std::vector<StripResult>& strips) {
  for (const StripResult& strip : strips) {
    if (!strip.failure.empty()) {
      fmt::print("  {}: {}\n", strip.mesh, strip.failure);
      continue;
    }
    const KesReading& r = strip.test.reading;
    print_row("  strip " + strip.mesh, {four_digits(r.rigidity), four_digits(r.loop_width),
                                        four_digits(r.residual), "", four_digits(r.loop_area)});
    const StripDifference d = difference(strip.test, amplitude);
    print_row("    against the law",
              {percent(d.rigidity), percent(d.loop_width), percent(d.residual), "", percent(d.loop_area)});
  }
}

}  // namespace hysteron::experiments
