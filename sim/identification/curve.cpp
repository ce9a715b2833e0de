#include "sim/identification/curve.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "sim/base/error.h"
#include "sim/identification/identification.h"
#include "sim/identification/solve.h"

namespace hysteron {

namespace {

constexpr double kUsualK0 = 50;      // [1/m]
constexpr double kSameModel = 1e-8;  // of the largest moment: the law is linear in b2 and g

// Least squares whose first two coefficients are >= 0, by trying which of them is zero.
Eigen::VectorXd nonnegative_solution(const Eigen::MatrixXd& columns, const Eigen::VectorXd& values) {
  Eigen::VectorXd best = Eigen::VectorXd::Zero(columns.cols());
  double least = INFINITY;
  for (const auto& [first, second] : {std::pair{1, 1}, {1, 0}, {0, 1}}) {
    Eigen::MatrixXd used = columns;
    used.col(0) *= first;
    used.col(1) *= second;
    Eigen::VectorXd solution = used.completeOrthogonalDecomposition().solve(values);
    solution[0] *= first;
    solution[1] *= second;
    const double sum = (columns * solution - values).squaredNorm();
    if (solution[0] < 0 || solution[1] < 0 || sum >= least) continue;
    best = solution;
    least = sum;
  }
  return best;
}

}  // namespace

MomentModel::MomentModel(const MomentSeries& series, const LawRequest& law, bool offset, bool cycling)
    : CurveModel(series.largest_curvature(), series.largest_moment() / series.largest_curvature()),
      law_(law),
      rows_(law_rows(series, cycling)),
      moment_(Eigen::Map<const Eigen::VectorXd>(series.moment.data(), series.rows())),
      offset_(offset),
      largest_(series.largest_moment()) {
  LawRequest request = law_;  // an unknown law or parameter is told here, and is no matter of the numbers
  request.curve = {slope_, slope_ / 2, std::min(kUsualK0, curvature_)};
  run_law(request, {LawRow{}});
}

Eigen::VectorXd MomentModel::moments(const CurvePoint& point) const {
  LawRequest request = law_;
  request.curve = point.curve();
  std::vector<double> all(rows_.size(), kNone);
  try {
    all = run_law(request, rows_).moment;
  } catch (const Error&) {
    // The law has bounds on its numbers: there it describes nothing.
  }
  const Eigen::Map<const Eigen::VectorXd> moments(all.data(), static_cast<int>(all.size()));
  return moments.tail(moment_.size()).array() + (offset_ ? point.nuisance[0] * largest_ : 0);
}

Eigen::VectorXd MomentModel::residuals(const CurvePoint& point) const {
  return (moments(point) - moment_) / largest_;
}

CurvePoint MomentModel::start() const {
  return {slope_ / 2, slope_ / 2, curvature_ / 2, Eigen::VectorXd::Zero(offset_ ? 1 : 0), 0};
}

CurvePoint MomentModel::best_at(double k0, int& iterations) const {
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(offset_ ? 1 : 0);
  const Eigen::VectorXd elastic = moments({slope_, 0, k0, zero, 0});
  Eigen::MatrixXd columns(moment_.size(), offset_ ? 3 : 2);
  columns.col(0) = elastic / largest_;
  columns.col(1) = (moments({slope_, slope_, k0, zero, 0}) - elastic) / largest_;
  if (offset_) columns.col(2).setOnes();
  if (!columns.allFinite()) return {slope_, slope_, k0, zero, INFINITY};
  Eigen::VectorXd best = nonnegative_solution(columns, moment_ / largest_);
  best.head<2>() = best.head<2>().cwiseMax(kSmallestRigidity);
  CurvePoint point{best[0] * slope_, best[1] * slope_, k0, best.tail(best.size() - 2), 0};
  point.sum = residuals(point).squaredNorm();
  const double foreseen = (columns * best - moment_ / largest_).squaredNorm();
  if (std::abs(point.sum - foreseen) <= kSameModel * static_cast<double>(moment_.size())) return point;
  const CurvePoint other = CurveModel::best_at(k0, iterations);
  return other.sum < point.sum ? other : point;
}

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
