#include "sim/identification/curve.h"

#include <cmath>

#include "sim/identification/solve.h"

namespace hysteron {
namespace {

// A cycle before the first row is believed when it lowers the residual to this share.
constexpr double kClearlyBetter = 0.95;
// A constant that raises twice the logarithm of the likelihood by this much is none of chance (4 standard
// errors).
constexpr double kClearOffset = 16;

void say_how(const MomentSeries& series, const Solution& solution, bool cycling, bool offset,
             Identification& result) {
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
                                rounded(solution.covariance.correlation) +
                                "): the law does not describe all of the curve, or the instrument drifts; "
                                "standard errors are widened " +
                                rounded(solution.covariance.widening) + " times");
  }
  if (!offset && solution.rise_with_offset() > kClearOffset) {
    result.statements.push_back(
        "the data lie off the law by a constant moment: the instrument's zero? --offset seeks it, too");
  }
}

void add_offset(const MomentSeries& series, const Solution& solution, Identification& result) {
  const double largest = series.largest_moment();
  result.further.emplace_back("offset_N", solution.used.nuisance[0] * largest);
  result.further.emplace_back("offset_N_stderr", largest * std::sqrt(solution.covariance.matrix(3, 3)));
}

}  // namespace

Identification identify_curve(const MomentSeries& series, const CurveQuestion& question) {
  MomentModel model(series, question.law, question.offset, false);
  Solution solution = solve(model);
  bool cycling = false;
  if (series.reversals > 0) {
    const MomentModel cycle(series, question.law, question.offset, true);
    const Solution other = solve(cycle);
    cycling = other.best.sum < kClearlyBetter * kClearlyBetter * solution.best.sum;
    if (cycling) {
      model = cycle;
      solution = other;
    }
  }
  Identification result;
  result.law = question.law.name;
  result.iterations = solution.iterations;
  result.curvature = series.drive;
  result.moment = series.moment;
  identify(model, question.assumptions,
           "least squares of the moments in " + series.name + ", law " + result.law, solution, result);
  const Eigen::VectorXd moments = model.moments(solution.used);
  result.model.assign(moments.begin(), moments.end());
  if (question.offset) add_offset(series, solution, result);
  say_how(series, solution, cycling, question.offset, result);
  return result;
}

}  // namespace hysteron
