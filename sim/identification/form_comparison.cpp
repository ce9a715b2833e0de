#include "sim/identification/form_comparison.h"

#include <algorithm>
#include <cmath>

#include "sim/identification/least_squares.h"

namespace hysteron {
namespace {

using Eigen::VectorXd;

constexpr double kSameEnds = 0.03;  // over the way between the ends

std::pair<double, double> ends(const FabLoops& loops, int cycle) {
  const std::vector<double>& out = loops.branches[2 * cycle].distance;
  const auto [low, high] = std::minmax_element(out.begin(), out.end());
  return {*low, *high};
}

bool repeats(const FabLoops& a, int cycle, const FabLoops& b, int other) {
  const auto [low, high] = ends(a, cycle);
  const auto [other_low, other_high] = ends(b, other);
  const double same = kSameEnds * (high - low);
  return std::abs(b.gauge / a.gauge - 1) < kSameGauge && std::abs(other_low - low) < same &&
         std::abs(other_high - high) < same;
}

// Returns the force at a distance on a branch whose distances rise or fall; NaN beyond its ends.
double force_at(const FabBranch& branch, double distance) {
  for (std::size_t i = 1; i < branch.distance.size(); ++i) {
    const double from = branch.distance[i - 1], to = branch.distance[i];
    if (from == to || (distance - from) * (distance - to) > 0) continue;
    const double part = (distance - from) / (to - from);
    return (1 - part) * branch.force[i - 1] + part * branch.force[i];
  }
  return kNone;
}

// Returns the differences of the forces of whole strips at the rows of `a`, less their mean [N].
std::vector<double> differences(const FabLoops& a, int cycle, const FabLoops& b, int other, double settling) {
  std::vector<double> all;
  for (int branch = 0; branch < 2; ++branch) {
    const FabBranch& own = a.branches[2 * cycle + branch];
    for (std::size_t i = 0; i < own.distance.size(); ++i) {
      if (is_settling(a, 2 * cycle + branch, i, settling)) continue;
      const double force = force_at(b.branches[2 * other + branch], own.distance[i]);
      if (std::isfinite(force)) all.push_back(a.width * own.force[i] - b.width * force);
    }
  }
  double mean = 0;
  for (const double d : all) mean += d / static_cast<double>(all.size());
  for (double& d : all) d -= mean;
  return all;
}

}  // namespace

Repeats find_repeats(const std::vector<FabLoops>& all, const std::vector<FabLoops>& fitted,
                     const FabBendingQuestion& question) {
  Repeats found;
  double squares = 0, products = 0, count = 0;
  for (const FabLoops& a : fitted)
    for (const int number : question.cycles)
      for (const FabLoops& b : all) {
        if (b.direction != a.direction || !b.bends() || !b.is_usable) continue;
        for (int other = 0; other < b.cycles(); ++other) {
          if ((b.test == a.test && other == number - 1) || !repeats(a, number - 1, b, other)) continue;
          const std::vector<double> d = differences(a, number - 1, b, other, question.settling);
          if (d.size() < 3) continue;
          for (std::size_t i = 0; i < d.size(); ++i) squares += d[i] * d[i];
          for (std::size_t i = 1; i < d.size(); ++i) products += d[i] * d[i - 1];
          count += static_cast<double>(d.size()) - 1;
          found.of.push_back(a.name() + " cycle " + std::to_string(number) + " and " + b.test + " cycle " +
                             std::to_string(other + 1));
        }
      }
  if (!found.known()) return found;
  found.noise = std::sqrt(squares / count / 2);
  found.correlation = squares > 0 ? products / squares : 0;
  return found;
}

FormComparison compare_forms(const FabForm& form, const FabBending& asked, const Repeats& repeats) {
  const VectorXd more = form.found.residuals.cwiseAbs2() - asked.residuals.cwiseAbs2();
  const double own = asked.residuals.squaredNorm() / static_cast<double>(more.size());
  // Residuals are over the assumed noise, which counts where no repeats give another.
  const double told = repeats.known() ? std::pow(repeats.noise / asked.noise, 2) : 1;
  const double variance = std::max(own, told);
  const int rows = static_cast<int>(more.size());
  const double one =
      rows_as_one(repeats.known() ? repeats.correlation : neighbour_correlation(asked.residuals), rows);
  if (!(variance > 0)) return {};
  FormComparison result;
  result.misfit = more.sum() / (variance * one);
  const double numbers = static_cast<double>(form.found.form.size()) - static_cast<double>(asked.form.size());
  const VectorXd scatter = more.array() - more.mean();
  const double of_rows = std::sqrt(scatter.squaredNorm() * rows_as_one(neighbour_correlation(scatter), rows)),
               deviation = std::hypot(of_rows / (variance * one), std::sqrt(2 * std::abs(numbers)));
  if (deviation > 0) result.preference = (result.misfit + 2 * numbers) / deviation;
  result.is_nearer = result.misfit < 0 && result.preference < -kNormal95;
  result.is_excluded = asked.is_parabola() && form.fixes_k0
                           ? result.misfit > kLikelihoodFall
                           : result.misfit > 0 && result.preference > kNormal95;
  return result;
}

void widen_errors(FabBending& asked, const std::vector<FabForm>& others, const Repeats& repeats) {
  double weights = 1, of_spring = 0, of_friction = 0;  // the form asked for has the weight 1
  for (const FabForm& form : others) {
    const double weight = std::exp(-compare_forms(form, asked, repeats).misfit / 2);
    weights += weight;
    of_spring += weight * std::pow(std::log(form.found.law.spring / asked.law.spring), 2);
    of_friction += weight * std::pow(std::log(form.found.law.friction() / asked.law.friction()), 2);
  }
  if (asked.spring_error > 0)  // for a decay it is given
    asked.spring_error = std::hypot(asked.spring_error, asked.law.spring * std::sqrt(of_spring / weights));
  asked.friction_error =
      std::hypot(asked.friction_error, asked.law.friction() * std::sqrt(of_friction / weights));
  asked.determined[0] = is_determined(asked.spring_error / asked.law.spring);
}

}  // namespace hysteron
