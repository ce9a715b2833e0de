#include "sim/identification/profile.h"

#include <algorithm>
#include <cmath>

#include "sim/base/error.h"
#include "sim/identification/curve.h"
#include "sim/identification/profile_line.h"
#include "sim/identification/solve.h"
#include "sim/identification/strip.h"

namespace hysteron {
namespace {

constexpr double kGravity = 9.81;  // [m/s^2] as in the scenes
constexpr int kTableRows = 50;

// The virgin curve has no memory of its own: `pabst` is it.
Identification identify_table(const MomentTable& table, const std::string& name,
                              const Assumptions& assumptions) {
  MomentSeries series;
  series.name = name;
  series.curvature = series.drive = table.curvature;
  series.moment = table.moment;
  CurveQuestion question;
  question.law.name = "pabst";
  question.assumptions = assumptions;
  return identify_curve(series, question);
}

void check_table(const MomentTable& table, const std::string& name) {
  const double bend = *std::max_element(table.curvature.begin(), table.curvature.end());
  if (!(bend > 0)) throw Error::request(name + ": the strip does not bend down: it has no curvature");
  check_rigidity(table.moment.back() / bend, "moment over curvature at the clamp of " + name);
}

// The table's moments by the law found.
std::vector<double> moments_by(const Identification& found, const MomentTable& table) {
  std::vector<LawRow> rows;
  for (double k : table.curvature) rows.push_back({k});
  return run_law({found.law, found.curve(), {}}, rows).moment;
}

void say_how(const SmoothProfile& line, double scatter, const Identification& from_table,
             Identification& result) {
  result.further.emplace_back("profile_length_m", line.parameters[3]);
  result.further.emplace_back("profile_scatter_m", scatter);
  result.further.emplace_back("table_b1_N_m", from_table.b1.value);
  result.further.emplace_back("table_b2_N_m", from_table.b2.value);
  result.further.emplace_back("table_k0_per_m", from_table.k0.value);
  result.statements.push_back(
      "the strip was only loaded: that it comes back by another curve, 2HB = (b1 - b2) k0 apart, is the "
      "law's "
      "reading of its bend and not seen in the data");
  result.statements.push_back(
      "a strip of this fabric hangs " + rounded(1e3 * scatter) +
      " mm (rms) from the points; moments and curvatures of the data are those of a smooth "
      "line with " +
      std::to_string(line.terms()) + " terms, through which alone b1 = " + rounded(from_table.b1.value) +
      " N m, b2 = " + rounded(from_table.b2.value) + " N m, k0 = " + rounded(from_table.k0.value) + "/m");
}

}  // namespace

MomentTable moment_table(const SmoothProfile& line, double weight) {
  const std::vector<Eigen::Vector2d> points = centre_line(line);
  const double length = line.parameters[3], step = length / kSegments;
  MomentTable table;
  double beyond = 0, moment_of_beyond = 0;  // length beyond s, and its integral of x
  const int stride = kSegments / kTableRows;
  for (int i = kSegments - 1; i >= 0; --i) {
    beyond += step;
    moment_of_beyond += step * (points[i].x() + points[i + 1].x()) / 2;
    if (i % stride) continue;
    table.curvature.push_back(bend(line, static_cast<double>(i) / kSegments) / length);
    table.moment.push_back(weight * (moment_of_beyond - beyond * points[i].x()));
  }
  return table;
}

Identification identify_profile(const Profile& profile, double density, const Assumptions& assumptions) {
  const SmoothProfile line = smooth(profile);
  const double weight = density * kGravity;
  const MomentTable table = moment_table(line, weight);
  check_table(table, profile.name);
  const Identification from_table = identify_table(table, profile.name, assumptions);

  const VirginCurve first = from_table.curve();
  const StripModel model(profile, line, weight,
                         {first.b2, std::max(first.b1 - first.b2, 0.01 * first.b1), first.k0, {}, 0});
  Solution solution = solve(model);
  solution.iterations += line.iterations + from_table.iterations;
  Identification result;
  result.law = "pabst";
  identify(model, assumptions, "shape of the sagging strip in " + profile.name, solution, result);
  result.curvature = table.curvature;
  result.moment = table.moment;
  result.model = moments_by(result, table);
  say_how(line, model.scatter(solution.used), from_table, result);
  return result;
}

}  // namespace hysteron
