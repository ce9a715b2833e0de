#include "sim/identification/moments.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "sim/base/error.h"
#include "sim/identification/identification.h"

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

}  // namespace hysteron
