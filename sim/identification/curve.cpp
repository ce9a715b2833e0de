#include "sim/identification/curve.h"

#include <algorithm>
#include <cmath>

#include "sim/base/error.h"
#include "sim/base/number_in.h"
#include "sim/identification/least_squares.h"
#include "sim/identification/model.h"
#include "sim/scene/key_table.h"

namespace hysteron {
namespace {

struct Interval {
  double low = kInfinity, high = 0;
  void include(double x) {
    low = std::min(low, x);
    high = std::max(high, x);
  }
  bool narrow() const { return high <= kWidestFactor * low; }
};

struct Solution {
  CurvePoint best;
  CurvePoint used;        // the best point, or the best under an assumption
  Covariance covariance;  // of MomentModel::parameters() at the best point
  Eigen::VectorXd residuals;
  Eigen::MatrixXd jacobian;  // by MomentModel::parameters()
  int iterations = 0;
  Interval b1, b2, k0;       // 95 % intervals by the scan
  bool k0_open = false;      // true if the interval of k0 reaches the scan's end
  Eigen::Vector3d errors;    // standard errors of the logarithms of b1, b2, k0, with their floor
  UnreadNumbers unread;      // numbers that the law does not read
  bool bend_unseen = false;  // too few rows lie on the bend after a sought turn
  double noise = 0;          // variance of a residual, at least that of kBestAccuracy

  // Returns twice the logarithm of the likelihood ratio between the best and another sum of squares.
  double fall(double sum) const { return (sum - best.sum) / noise; }
  // Returns its rise with a constant added to all residuals (score test; Rao 1948).
  double rise_with_offset() const {
    const Eigen::VectorXd ones = Eigen::VectorXd::Ones(residuals.size());
    const Eigen::VectorXd beside = ones - jacobian * linear_least_squares(jacobian, ones);
    const double variance = residuals.squaredNorm() / static_cast<double>(residuals.size());
    return std::pow(beside.dot(residuals), 2) / (beside.squaredNorm() * std::max(variance, 1e-300));
  }
};

// Returns the standard errors of the logarithms of b1, b2, k0.
Eigen::Vector3d relative_errors(const CurvePoint& point, const Eigen::MatrixXd& covariance) {
  const double b1 = point.b2 + point.g;
  Eigen::MatrixXd to_named = Eigen::MatrixXd::Zero(3, covariance.cols());
  to_named.row(0).head<2>() << point.b2 / b1, point.g / b1;
  to_named(1, 0) = 1;
  to_named(2, 2) = 1;
  return (to_named * covariance * to_named.transpose()).diagonal().cwiseMax(0).cwiseSqrt();
}

void find_intervals(const std::vector<CurvePoint>& scan, Solution& solution) {
  const auto include = [&](const CurvePoint& point) {
    solution.b1.include(point.b2 + point.g);
    solution.b2.include(point.b2);
    solution.k0.include(point.k0);
  };
  solution.errors = relative_errors(solution.best, solution.covariance.with_floor);
  include(solution.best);
  for (const CurvePoint& point : scan) {
    if (solution.fall(point.sum) <= kLikelihoodFall) include(point);
  }
  solution.k0_open = solution.fall(scan.back().sum) <= kLikelihoodFall;
}

const CurvePoint& deepest(const std::vector<CurvePoint>& points) {
  return *std::min_element(points.begin(), points.end(),
                           [](const CurvePoint& a, const CurvePoint& b) { return a.sum < b.sum; });
}

// Minimises over all parameters together, from a point.
Solution minimum_from(const MomentModel& model, const CurvePoint& start, SearchLimits limits = {}) {
  if (!std::isfinite(start.sum))
    throw Error::simulation("no b1, b2 and k0 were found with which the law says anything of these data");
  Solution solution;
  const Eigen::VectorXd first = model.parameters(start);
  const int size = static_cast<int>(first.size());
  const auto [low, high] = model.bounds();
  const LeastSquares fit = minimize([&](const Eigen::VectorXd& p) { return model.residuals(model.point(p)); },
                                    first, low, high, limits);
  solution.iterations = fit.iterations;
  solution.best = model.point(fit.parameters);
  solution.best.sum = fit.residuals.squaredNorm();
  solution.used = solution.best;
  solution.residuals = fit.residuals;
  solution.jacobian = fit.jacobian;
  solution.covariance = covariance(fit.jacobian, fit.residuals);
  const auto freedom = std::max<double>(1, static_cast<double>(fit.residuals.size() - size));
  const double widening = solution.covariance.widening;
  solution.noise = widening * widening * std::max(solution.best.sum / freedom, kBestAccuracy * kBestAccuracy);
  solution.unread = model.unread(solution.best);
  return solution;
}

Solution solve(const MomentModel& model) {
  int iterations = 0;
  const std::vector<CurvePoint> scan = model.scan(iterations);
  Solution solution = minimum_from(model, deepest(scan));
  solution.iterations += iterations;
  find_intervals(scan, solution);
  return solution;
}

// Minimises over all parameters together, turns among them, from the minimum with turns at the rows.
Solution minimum_with_turns(const MomentModel& model, const CurvePoint& at_rows) {
  // A turn has another effect before a row than after it: a search that crosses from one side to the other is
  // slow to end.
  Solution solution = minimum_from(model, model.start_with_turns(at_rows), {50, 1e-7, 3});
  // The few rows beside turns determine k0.  If they lie on the law by chance, their noise is taken as that
  // of the others.
  const Covariance even = covariance(solution.jacobian, solution.residuals, true);
  if (even.matrix(2, 2) > solution.covariance.matrix(2, 2)) solution.covariance = even;
  return solution;
}

// Follows turns with k0 on both sides of the minimum as far as the data allow it.
void find_intervals_with_turns(const MomentModel& model, Solution& solution) {
  constexpr SearchLimits kRough = {20, 1e-4, 3};
  std::vector<double> below, above = model.scanned_k0();
  const auto first = std::upper_bound(above.begin(), above.end(), solution.best.k0);
  below.assign(std::make_reverse_iterator(first), above.rend());
  above.erase(above.begin(), first);
  std::vector<CurvePoint> followed;
  for (const std::vector<double>& side : {below, above}) {
    CurvePoint point = solution.best;
    for (const double k0 : side) {
      point.k0 = k0;
      point = model.searched_from(point, solution.iterations, kRough);
      followed.push_back(point);
      if (solution.fall(point.sum) > kLikelihoodFall) break;
    }
  }
  find_intervals(followed, solution);
}

void take(const Solution& solution, const std::string& source, Identification& result) {
  const Eigen::Vector3d error = relative_errors(solution.best, solution.covariance.matrix);
  const auto estimate = [&](double value, int i, bool narrow) {
    Estimate e{value, error[i] * value, narrow && is_determined(solution.errors[i]), source};
    if (!e.determined) e.standard_error = kNone;
    return e;
  };
  const bool sees_bend = !solution.bend_unseen;
  result.b1 = estimate(solution.best.b2 + solution.best.g, 0,
                       solution.b1.narrow() && !solution.unread.b1 && sees_bend);
  result.b2 = estimate(solution.best.b2, 1, solution.b2.narrow());
  result.k0 = estimate(solution.best.k0, 2,
                       solution.k0.narrow() && !solution.k0_open && !solution.unread.k0 && sees_bend);
  result.iterations = solution.iterations;
}

std::string range_text(const Interval& interval, bool open, const char* unit) {
  if (open) return "values above " + number_text(interval.low, 4) + " " + unit;
  return "values from " + number_text(interval.low, 4) + " to " + number_text(interval.high, 4) + " " + unit;
}

void say_undetermined(const Solution& solution, Identification& result) {
  const auto say = [&](const char* name, const Estimate& estimate, const Interval& interval, bool open,
                       const char* unit) {
    if (estimate.determined) return;
    const bool local =
        interval.narrow() && !open;  // at the best fit other numbers can take its place already
    result.statements.push_back(
        std::string(name) + " is not determined: " +
        (local ? solution.bend_unseen ? "less than two rows lie on the bend of 2 k0 after a turn between rows"
                                      : "its standard error is of its own size"
               : range_text(interval, open, unit) + " describe the data as well (95 %)"));
  };
  if (!solution.unread.b1) say("b1", result.b1, solution.b1, false, "N m");
  say("b2", result.b2, solution.b2, false, "N m");
  if (!solution.unread.b1 || !solution.unread.k0) say("k0", result.k0, solution.k0, solution.k0_open, "1/m");
}

void assume(Estimate& estimate, double value, const std::string& source) {
  estimate.value = value;
  estimate.source = source;
  estimate.confidence = "assumed";
}

// The law does not read b1: assumes b2/b1, or b1 = b2 if it does not read k0 either.
void take_unread(const Assumptions& assumptions, Solution& solution, Identification& result) {
  const std::string unread = "no moment of law " + result.law + " changes with ";
  CurvePoint& used = solution.used;
  if (!solution.unread.k0) {
    used.g = used.b2 / assumptions.ratio - used.b2;
    assume(result.b1, used.b2 + used.g, unread + "it; " + assumptions.ratio_source());
  } else {
    used.g = 0;
    assume(result.b1, used.b2, unread + "it; b1 = b2 is taken");
    result.k0 = assumptions.assumed_k0();
    used.k0 = result.k0.value;
  }
  result.statements.push_back(std::string("b1 ") + (solution.unread.k0 ? "and k0 are" : "is") +
                              " not determined: " + unread + (solution.unread.k0 ? "them" : "it"));
}

// If b2 and k0 are open, but the slope and the bend of the curve (b1 and c1) are not, assumes b2 = ratio b1.
bool assume_ratio(const MomentModel& model, const Assumptions& assumptions, Solution& solution,
                  Identification& result) {
  const CurvePoint& best = solution.best;
  const double ratio = assumptions.ratio, b1 = best.b2 + best.g;
  const double k0 = std::max((1 - ratio) * b1 * best.k0 / best.g, model.largest_curvature());
  const auto numbers = [&](const Eigen::VectorXd& factor) {
    const double stiffness = b1 * factor[0];
    return CurvePoint{ratio * stiffness, (1 - ratio) * stiffness, k0 * factor[1], {}, 0};
  };
  const Tied tied = fit_tied(model, numbers, 2, best);
  result.iterations += tied.iterations;
  if (solution.fall(tied.best.sum) > kLikelihoodFall) return false;
  solution.used = tied.best;
  const double value = tied.best.b2 + tied.best.g;
  result.b1.value = value;
  const Eigen::MatrixXd c = covariance(tied.jacobian, tied.residuals).matrix;
  result.b1.standard_error = value * std::sqrt(c(0, 0));
  assume(result.b2, tied.best.b2, assumptions.ratio_source());
  assume(result.k0, tied.best.k0,
         "follows from the curve's bend and the ratio b2/b1, which is " + assumptions.ratio_source());
  const double c1 = tied.best.curve().c1();
  result.further.emplace_back("c1_N_m2", c1);
  result.further.emplace_back("c1_N_m2_stderr", -c1 * std::sqrt(c(0, 0) + c(1, 1) - 2 * c(0, 1)));
  result.statements.push_back("the data fix b1 and the bend c1 = (b2 - b1)/(2 k0) = " + number_text(c1, 4) +
                              " N m^2; " + assumptions.ratio_source());
  return true;
}

// If b2 is fixed but the way to it is not, assumes k0 as for fabrics from KES.
bool assume_k0(const MomentModel& model, const Assumptions& assumptions, Solution& solution,
               Identification& result) {
  const CurvePoint start = model.best_at(assumptions.k0, result.iterations);
  const auto numbers = [&](const Eigen::VectorXd& factor) {
    return CurvePoint{start.b2 * factor[0], start.g * factor[1], assumptions.k0, {}, 0};
  };
  const Tied tied = fit_tied(model, numbers, 2, start);
  result.iterations += tied.iterations;
  if (solution.fall(tied.best.sum) > kLikelihoodFall) return false;
  solution.used = tied.best;
  const double b2 = tied.best.b2, b1 = b2 + tied.best.g;
  const Eigen::MatrixXd c = covariance(tied.jacobian, tied.residuals).matrix;
  const Eigen::Vector2d weight(b2 / b1, tied.best.g / b1);
  result.b2.value = b2;
  result.b2.standard_error = b2 * std::sqrt(c(0, 0));
  assume(result.k0, assumptions.k0, assumptions.k0_source());
  if (result.b1.determined) {
    result.b1.value = b1;
    result.b1.standard_error = b1 * std::sqrt(weight.dot(c.topLeftCorner<2, 2>() * weight));
  } else {
    assume(result.b1, b1, "follows from b2, the friction moment and k0, which is " + assumptions.k0_source());
  }
  const double hb = tied.best.curve().friction_moment();
  result.further.emplace_back("HB_N", hb);
  result.further.emplace_back("HB_N_stderr", hb * std::sqrt(c(1, 1)));
  result.statements.push_back("the data fix b2 and the friction moment HB = (b1 - b2) k0/2 = " +
                              number_text(hb, 4) + " N; " + assumptions.k0_source());
  return true;
}

// Is there no bend and no loop beyond the noise? Then b1 is the slope, and nothing is known beyond it.
bool is_straight(const MomentModel& model, const Assumptions& assumptions, Solution& solution,
                 Identification& result) {
  const double b1 = solution.best.b2 + solution.best.g;
  const auto numbers = [&](const Eigen::VectorXd& factor) {
    return CurvePoint{b1 * factor[0], 0, assumptions.k0, {}, 0};
  };
  const Tied line = fit_tied(model, numbers, 1, solution.best);
  if (solution.fall(line.best.sum) > kLikelihoodFall) return false;
  solution.used = line.best;
  const Covariance c = covariance(line.jacobian, line.residuals);
  result.b1.value = line.best.b2;
  result.b1.determined = is_determined(std::sqrt(c.with_floor(0, 0)));
  result.b1.standard_error = result.b1.determined ? line.best.b2 * std::sqrt(c.matrix(0, 0)) : kNone;
  result.b2 = {line.best.b2, kNone, false, "b2 = b1: the data show no bend", "assumed"};
  result.k0 = assumptions.assumed_k0();
  const std::string range = " up to " + number_text(model.largest_curvature(), 4) + " 1/m; b2 = b1 is taken";
  result.statements.push_back(solution.covariance.widening > 1
                                  ? "the law describes these data no better with friction than without it" +
                                        range
                                  : "within its noise the curve is a straight line without a loop: it fixes "
                                    "b1 and shows neither a bend nor "
                                    "friction" +
                                        range);
  return true;
}

// Puts numbers with standard errors into `result`.  A number is undetermined if the scan's interval or the
// standard error's (from the singular values of the scaled Jacobian) is wider than kWidestFactor; if an
// assumption then describes the data as well, it is used, and sets Solution::used.  `source` is noted for
// fitted numbers.
void identify(const MomentModel& model, const Assumptions& assumptions, const std::string& source,
              Solution& solution, Identification& result) {
  take(solution, source, result);
  if (solution.unread.b1) {
    take_unread(assumptions, solution, result);
    say_undetermined(solution, result);
    return;
  }
  if (!result.k0.determined && is_straight(model, assumptions, solution, result)) return;
  say_undetermined(solution, result);
  if (result.k0.determined || (!result.b2.determined && !result.b1.determined)) return;
  const bool by_k0 = result.b2.determined;
  if ((by_k0 ? assume_k0 : assume_ratio)(model, assumptions, solution, result)) return;
  result.statements.push_back("the usual assumption (" +
                              (by_k0 ? assumptions.k0_source() : assumptions.ratio_source()) +
                              ") contradicts the data; the best fit stands");
}

// A cycle before the first row is accepted when it lowers the residual to this share.
constexpr double kClearlyBetter = 0.95;
// A constant that raises twice the logarithm of the likelihood by this much is not due to chance (4 standard
// errors).
constexpr double kClearOffset = 16;

// A turn that lies half a step beyond its row lowers k0 by that share of the step.  Where that is more than 2
// % of k0, turns are sought between the rows.
constexpr double kLargestStepAtTurns = 1. / 25;  // over k0

// A reading of the data, whose history before the first row is the virgin cloth's or that of the same cycles.
struct Reading {
  MomentModel model;
  Solution solution;
  bool cycling;
  bool with_turns = false;
};

// Reads the data; better_reading() finds intervals where turns are sought.
Reading reading(const MomentSeries& series, const CurveQuestion& question, SoughtBeside beside,
                bool cycling) {
  const MomentModel at_rows(series, question.law, beside, cycling);
  const Reading found{at_rows, solve(at_rows), cycling};
  if (found.solution.unread.k0) return found;
  beside.step_at_turns = kLargestStepAtTurns * found.solution.best.k0;
  const auto turns = static_cast<int>(sought_turns(series, cycling, beside.step_at_turns).size());
  if (turns == 0 || series.rows() < found.solution.jacobian.cols() + turns) return found;
  const MomentModel between(series, question.law, beside, cycling);
  return {between, minimum_with_turns(between, found.solution.best), cycling, true};
}

Reading better_reading(const MomentSeries& series, const CurveQuestion& question, SoughtBeside beside) {
  Reading best = reading(series, question, beside, false);
  if (series.reversals > 0) {
    const Reading cycle = reading(series, question, beside, true);
    if (cycle.solution.best.sum < kClearlyBetter * kClearlyBetter * best.solution.best.sum) best = cycle;
  }
  if (best.with_turns) {
    find_intervals_with_turns(best.model, best.solution);
    best.solution.bend_unseen = best.model.largest_step_at_turns() > best.solution.best.k0;
  }
  return best;
}

// Do the data ask for a zero of curvature? Data that a law does not follow do, if it raises twice the
// logarithm of the likelihood clearly, and lowers the residual clearly below that with a zero of moment.
bool asks_for_curvature_offset(const MomentSeries& series, const CurveQuestion& question,
                               const Solution& without) {
  if (question.curvature_offset || without.covariance.widening <= 1) return false;
  const Solution with = better_reading(series, question, {question.offset, true}).solution;
  const double rows = series.rows() / (with.covariance.widening * with.covariance.widening);
  if (!(rows * std::log(without.best.sum / with.best.sum) > kClearOffset)) return false;
  const double of_moment = better_reading(series, question, {true, false}).solution.best.sum;
  return with.best.sum < kClearlyBetter * kClearlyBetter * of_moment;
}

// Says which zero of the instrument the data ask for that is not sought.
void say_offset(const MomentSeries& series, const CurveQuestion& question, const Solution& solution,
                Identification& result) {
  const auto say = [&](const char* quantity, const char* flag) {
    result.statements.push_back(std::string("the data lie off the law by a constant ") + quantity +
                                ": the instrument's zero? " + flag + " seeks it, too");
  };
  if (asks_for_curvature_offset(series, question, solution)) {
    say("curvature", "--curvature-offset");
  } else if (!question.offset && solution.rise_with_offset() > kClearOffset) {
    say("moment", "--offset");
  }
}

void say_how(const MomentSeries& series, const Solution& solution, bool cycling, Identification& result) {
  if (series.reversals == 0) {
    result.statements.push_back(
        "the curve has no way back: that it returns by another one, 2HB = (b1 - b2) k0 apart, is the law's "
        "reading of it and not seen in the data (an elastic curve of the same bend would fit as well)");
  }
  if (cycling) {
    result.statements.push_back(
        "the first row is in the middle of a cycle: the law went through all rows once before");
  }
  if (solution.covariance.widening > 1) {
    result.statements.push_back("neighbouring residuals are correlated (" +
                                number_text(solution.covariance.correlation, 4) +
                                "): the law does not describe all of the curve, or the instrument drifts; "
                                "standard errors are widened " +
                                number_text(solution.covariance.widening, 4) + " times");
  }
}

void say_turns(const MomentModel& model, const Solution& solution, Identification& result) {
  std::vector<std::string> curvatures;
  for (const double k : model.turning_curvatures(solution.used)) curvatures.push_back(number_text(k, 4));
  result.statements.push_back(
      "rows are not close beside the turns for this k0: the turns were sought "
      "between the rows, too, and lie at " +
      join(curvatures, ", ") + " 1/m");
}

void add_offsets(const MomentSeries& series, const CurveQuestion& question, const Solution& solution,
                 Identification& result) {
  int sought = 0;
  const auto add = [&](const std::string& name, double unit) {
    const int parameter = 3 + sought;  // parameters follow b2, g and k0
    result.further.emplace_back(name, solution.used.nuisance[sought] * unit);
    result.further.emplace_back(name + "_stderr",
                                unit * std::sqrt(solution.covariance.matrix(parameter, parameter)));
    ++sought;
  };
  if (question.offset) add("offset_N", series.largest_moment());
  if (question.curvature_offset) add("curvature_offset_per_m", series.largest_curvature());
}

}  // namespace

Identification identify_curve(const MomentSeries& series, const CurveQuestion& question) {
  const auto [model, found, cycling, with_turns] =
      better_reading(series, question, {question.offset, question.curvature_offset});
  Solution solution = found;
  Identification result;
  result.law = question.law.name;
  result.iterations = solution.iterations;
  result.curvature = series.drive;
  result.moment = series.moment;
  identify(model, question.assumptions,
           "least squares of the moments in " + series.name + ", law " + result.law, solution, result);
  const Eigen::VectorXd moments = model.moments(solution.used);
  result.model.assign(moments.begin(), moments.end());
  add_offsets(series, question, solution, result);
  say_how(series, solution, cycling, result);
  if (with_turns) say_turns(model, solution, result);
  say_offset(series, question, solution, result);
  return result;
}

}  // namespace hysteron
