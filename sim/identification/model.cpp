#include "sim/identification/model.h"

#include <algorithm>
#include <cmath>

#include "sim/identification/least_squares.h"

namespace hysteron {
namespace {

constexpr int kScanned = 36;                       // k0 a factor of 1.26 apart,
constexpr double kScanLow = 1e-2, kScanHigh = 30;  // over the largest curvature
constexpr double kLargestRigidity = 1e4;
constexpr double kWide = 100;          // of nuisance: no bound
constexpr double kFarthestFactor = 9;  // logarithm

}  // namespace

Eigen::VectorXd CurveModel::parameters(const CurvePoint& point) const {
  Eigen::VectorXd result(3 + point.nuisance.size());
  result[0] = std::log(point.b2 / slope_);
  result[1] = std::log(point.g / slope_);
  result[2] = std::log(point.k0 / curvature_);
  result.tail(point.nuisance.size()) = point.nuisance;
  return result;
}

CurvePoint CurveModel::point(const Eigen::VectorXd& parameters) const {
  return {std::exp(parameters[0]) * slope_, std::exp(parameters[1]) * slope_,
          std::exp(parameters[2]) * curvature_, parameters.tail(parameters.size() - 3), 0};
}

Eigen::VectorXd CurveModel::low(int size) const {
  Eigen::VectorXd result = Eigen::VectorXd::Constant(size, -kWide);
  result[0] = result[1] = std::log(kSmallestRigidity);
  result[2] = std::log(kScanLow / 2);
  return result;
}

Eigen::VectorXd CurveModel::high(int size) const {
  Eigen::VectorXd result = Eigen::VectorXd::Constant(size, kWide);
  result[0] = result[1] = std::log(kLargestRigidity);
  result[2] = std::log(kScanHigh * 2);
  return result;
}

CurvePoint CurveModel::best_at(double k0, int& iterations) const {
  const CurvePoint begin = start();
  const auto numbers = [&](const Eigen::VectorXd& factor) {
    return CurvePoint{begin.b2 * factor[0], begin.g * factor[1], k0, {}, 0};
  };
  const Tied tied = fit_tied(*this, numbers, 2, begin);
  iterations += tied.iterations;
  return tied.best;
}

std::vector<CurvePoint> CurveModel::scan(int& iterations) const {
  std::vector<CurvePoint> points;
  for (int i = 0; i < kScanned; ++i) {
    const double fraction = static_cast<double>(i) / (kScanned - 1);
    points.push_back(best_at(curvature_ * kScanLow * std::pow(kScanHigh / kScanLow, fraction), iterations));
  }
  return points;
}

Tied fit_tied(const CurveModel& model, const FromFactors& numbers, int factors, const CurvePoint& start) {
  const int others = static_cast<int>(start.nuisance.size());
  const auto point = [&](const Eigen::VectorXd& p) {
    CurvePoint result = numbers(p.head(factors).array().exp());
    result.nuisance = p.tail(others);
    return result;
  };
  Eigen::VectorXd first = Eigen::VectorXd::Zero(factors + others);
  first.tail(others) = start.nuisance;
  Eigen::VectorXd wide = Eigen::VectorXd::Constant(first.size(), kWide);
  wide.head(factors).setConstant(kFarthestFactor);
  const LeastSquares fit =
      minimize([&](const Eigen::VectorXd& p) { return model.residuals(point(p)); }, first, -wide, wide);
  Tied tied{point(fit.parameters), fit.residuals, fit.jacobian, fit.iterations};
  tied.best.sum = fit.residuals.allFinite() ? fit.residuals.squaredNorm() : INFINITY;
  return tied;
}

}  // namespace hysteron
