#include "experiments/kes/strip_output.h"

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

void write_strip_metrics(Run& run, const std::string& prefix, double amplitude, const StripResult& strip) {
  if (!strip.renderer.empty()) run.manifest().renderer = strip.renderer;
  if (strip.failure.empty())
    write_strip_readings(run, prefix, strip, difference(strip.test, amplitude));
  else
    run.metric(prefix + "strip_failure", strip.failure);
}

void write_strip_table(Run& run, const std::string& ending, const StripResult& strip) {
  std::vector<Column> columns = {{"curvature [1/m]", {}},
                                 {"law moment [N]", strip.test.law_moment},
                                 {strip.mesh + " moment [N]", strip.test.moment}};
  for (const LawRow& row : strip.walk.rows) columns[0].values.push_back(row.curvature);
  if (!strip.test.free_curvature.empty())
    columns.push_back({strip.mesh + " free curvature [1/m]", strip.test.free_curvature});
  Table(columns).write(run.path("strip" + ending + ".csv"));
}

}  // namespace hysteron::experiments
