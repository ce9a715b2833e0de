// The only file that includes Ceres: it costs seconds to compile.
#include "sim/identification/least_squares.h"

#include <ceres/ceres.h>
#include <glog/logging.h>
#include <Eigen/QR>
#include <Eigen/SVD>
#include <algorithm>
#include <cassert>
#include <cmath>

#include "sim/identification/identification.h"

namespace hysteron {

namespace {

// The step for a parameter of order one: central differences then lose about 1e-8 to truncation and 1e-12 to
// rounding.
constexpr double kDifference = 1e-4;

Eigen::MatrixXd numerical_jacobian(const Residuals& residuals, const Eigen::VectorXd& at) {
  Eigen::MatrixXd jacobian;
  for (int j = 0; j < at.size(); ++j) {
    Eigen::VectorXd above = at, below = at;
    above[j] += kDifference;
    below[j] -= kDifference;
    const Eigen::VectorXd column = (residuals(above) - residuals(below)) / (2 * kDifference);
    if (j == 0) jacobian.resize(column.size(), at.size());
    jacobian.col(j) = column;
  }
  return jacobian;
}

// Silences Ceres, which logs numerical failures to stderr, whatever its options say; the caller reports their
// consequences.
void keep_ceres_quiet() {
  static const int once = FLAGS_minloglevel = google::GLOG_FATAL;
  (void)once;
}

class Cost : public ceres::CostFunction {
 public:
  Cost(const Residuals& residuals, int rows, int parameters) : residuals_(residuals) {
    set_num_residuals(rows);
    mutable_parameter_block_sizes()->push_back(parameters);
  }

  bool Evaluate(double const* const* blocks, double* values, double** jacobians) const override {
    const Eigen::VectorXd at = Eigen::Map<const Eigen::VectorXd>(blocks[0], parameter_block_sizes()[0]);
    const Eigen::VectorXd residuals = residuals_(at);
    if (!residuals.allFinite()) return false;
    Eigen::Map<Eigen::VectorXd>(values, num_residuals()) = residuals;
    if (jacobians && jacobians[0]) {
      using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
      const Eigen::MatrixXd jacobian = numerical_jacobian(residuals_, at);
      if (!jacobian.allFinite()) return false;
      if (at.size() == 1) {
        Eigen::Map<Eigen::VectorXd>(jacobians[0], num_residuals()) = jacobian.col(0);
      } else {
        Eigen::Map<RowMajor>(jacobians[0], num_residuals(), at.size()) = jacobian;
      }
    }
    return true;
  }

 private:
  const Residuals& residuals_;
};

}  // namespace

LeastSquares minimize(const Residuals& residuals, const Eigen::VectorXd& start, const Eigen::VectorXd& low,
                      const Eigen::VectorXd& high, SearchLimits limits) {
  keep_ceres_quiet();
  LeastSquares result;
  result.parameters = start.cwiseMax(low).cwiseMin(high);
  const int size = static_cast<int>(start.size()), rows = static_cast<int>(residuals(start).size());
  ceres::Problem problem;
  problem.AddResidualBlock(new Cost(residuals, rows, size), nullptr, result.parameters.data());
  for (int j = 0; j < size; ++j) {
    problem.SetParameterLowerBound(result.parameters.data(), j, low[j]);
    problem.SetParameterUpperBound(result.parameters.data(), j, high[j]);
  }
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;
  options.max_num_iterations = limits.iterations;
  options.function_tolerance = limits.change;
  options.max_num_line_search_step_size_iterations = limits.halvings;
  options.parameter_tolerance = 1e-10;
  options.gradient_tolerance = 1e-14;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  result.iterations = summary.num_successful_steps + summary.num_unsuccessful_steps;
  result.converged = summary.termination_type == ceres::CONVERGENCE;
  result.residuals = residuals(result.parameters);
  result.jacobian = numerical_jacobian(residuals, result.parameters);
  return result;
}

bool is_deeper(const LeastSquares& a, const LeastSquares& b) {
  constexpr double kDeeper = 0.01;  // of the sum of squares, or of one: searches end no nearer to a minimum
  return a.sum() < b.sum() - kDeeper * std::max(1.0, b.sum());
}

Eigen::VectorXd linear_least_squares(const Eigen::MatrixXd& a, const Eigen::VectorXd& b) {
  return a.completeOrthogonalDecomposition().solve(b);
}

namespace {

constexpr double kSmallestSingular = 1e-9;  // over the largest one: derivatives are no more accurate
constexpr double kSignificant = 2;          // standard deviations of a correlation of independent residuals
constexpr double kLargestCorrelation = 0.98;
constexpr double kRounding = kBestAccuracy / 100;  // smaller residuals are no noise of an instrument

}  // namespace

double neighbour_correlation(const Eigen::VectorXd& residuals) {
  const int n = static_cast<int>(residuals.size());
  const double square = residuals.squaredNorm();
  if (n < 3 || square <= n * kRounding * kRounding) return 0;
  return residuals.head(n - 1).dot(residuals.tail(n - 1)) / square;
}

double rows_as_one(double correlation, int rows) {
  if (correlation <= kSignificant / std::sqrt(rows)) return 1;
  const double r = std::min(correlation, kLargestCorrelation);
  return (1 + r) / (1 - r);
}

Covariance covariance(const Eigen::MatrixXd& jacobian, const Eigen::VectorXd& residuals, bool is_even) {
  const int n = static_cast<int>(residuals.size());
  assert(jacobian.rows() >= jacobian.cols());
  Eigen::VectorXd scale = jacobian.colwise().norm();
  for (double& length : scale) length = length > 0 ? length : 1;
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(jacobian * scale.cwiseInverse().asDiagonal(),
                                              Eigen::ComputeThinU | Eigen::ComputeThinV);
  const Eigen::VectorXd singular = svd.singularValues().cwiseMax(kSmallestSingular * svd.singularValues()[0]);
  const Eigen::MatrixXd inverse = scale.cwiseInverse().asDiagonal() * svd.matrixV() *
                                  singular.cwiseInverse().asDiagonal() * svd.matrixU().transpose();
  Covariance result;
  result.correlation = neighbour_correlation(residuals);
  result.widening = std::sqrt(rows_as_one(result.correlation, n));
  const Eigen::VectorXd leverage = svd.matrixU().rowwise().squaredNorm();
  Eigen::VectorXd variance(n);
  for (int i = 0; i < n; ++i) variance[i] = residuals[i] * residuals[i] / std::max(1 - leverage[i], 1.0 / n);
  const auto freedom = static_cast<double>(n - jacobian.cols());
  if (is_even) variance.setConstant(residuals.squaredNorm() / std::max(1., freedom));
  const double widened = result.widening * result.widening;
  result.matrix = widened * inverse * variance.asDiagonal() * inverse.transpose();
  const Eigen::MatrixXd floor = kBestAccuracy * kBestAccuracy * inverse * inverse.transpose();
  result.with_floor = result.matrix + floor;
  return result;
}

bool is_determined(double relative_error) { return 2 * 1.96 * relative_error <= std::log(kWidestFactor); }

}  // namespace hysteron
