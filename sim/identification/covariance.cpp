#include "sim/identification/covariance.h"

#include <Eigen/SVD>
#include <algorithm>
#include <cassert>
#include <cmath>

#include "sim/identification/identification.h"

namespace hysteron {
namespace {

constexpr double kSmallestSingular = 1e-9;  // of the largest: derivatives are no more accurate
constexpr double kSignificant = 2;          // standard deviations of a correlation of independent residuals
constexpr double kLargestCorrelation = 0.98;
constexpr double kRounding = kBestAccuracy / 100;  // residuals below are no noise of an instrument

double neighbour_correlation(const Eigen::VectorXd& residuals) {
  const int n = static_cast<int>(residuals.size());
  const double square = residuals.squaredNorm();
  if (n < 3 || square <= n * kRounding * kRounding) return 0;
  return residuals.head(n - 1).dot(residuals.tail(n - 1)) / square;
}

}  // namespace

Covariance covariance(const Eigen::MatrixXd& jacobian, const Eigen::VectorXd& residuals) {
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
  if (result.correlation > kSignificant / std::sqrt(n)) {
    const double r = std::min(result.correlation, kLargestCorrelation);
    result.widening = std::sqrt((1 + r) / (1 - r));
  }
  const Eigen::VectorXd leverage = svd.matrixU().rowwise().squaredNorm();
  Eigen::VectorXd variance(n);
  for (int i = 0; i < n; ++i) variance[i] = residuals[i] * residuals[i] / std::max(1 - leverage[i], 1.0 / n);
  const double widened = result.widening * result.widening;
  result.matrix = widened * inverse * variance.asDiagonal() * inverse.transpose();
  const Eigen::MatrixXd floor = kBestAccuracy * kBestAccuracy * inverse * inverse.transpose();
  result.with_floor = result.matrix + floor;
  return result;
}

bool is_determined(double relative_error) { return 2 * 1.96 * relative_error <= std::log(kWidestFactor); }

}  // namespace hysteron
