#include "sim/identification/friction_form.h"

#include <cmath>

#include "sim/scene/key_table.h"

namespace hysteron {
namespace {

using Eigen::VectorXd;

constexpr double kMomentSpread = 1.5;  // prior standard deviation of a logarithm: a factor of 4.5
constexpr double kMedianSpread = 1.5, kShapeSpread = 0.7;

}  // namespace

FrictionForm free_stops(const std::vector<double>& thresholds) {
  const auto count = static_cast<double>(thresholds.size());
  return {std::to_string(thresholds.size()) + (thresholds.size() == 1 ? " stop" : " stops"),
          std::vector<double>(thresholds.size(), kMomentSpread), [=](const VectorXd& p, double moment) {
            Spectrum stops{thresholds, {}};
            for (std::size_t j = 0; j < thresholds.size(); ++j)
              stops.stiffnesses.push_back(std::exp(p[static_cast<int>(j)]) * moment / count / thresholds[j]);
            return stops;
          }};
}

FrictionShape shape_of(const VectorXd& p) {
  return {kUsualMedian * std::exp(p[1]), kUsualSpread * std::exp(p[2])};
}

FrictionForm shaped_friction() {
  return {"shaped", {kMomentSpread, kMedianSpread, kShapeSpread}, [](const VectorXd& p, double moment) {
            return shaped_stops(shape_of(p), std::exp(p[0]) * moment);
          }};
}

FrictionForm even_friction(double k0) {
  return {"k0 = " + number_text(k0) + "/m", {kMomentSpread}, [=](const VectorXd& p, double moment) {
            return even_stops(2 * std::exp(p[0]) * moment / k0, k0);
          }};
}

VectorXd stop_errors(const FrictionForm& form, const VectorXd& parameters,
                     const Eigen::MatrixXd& covariance) {
  constexpr double kStep = 1e-4;
  const auto logarithms = [&](const VectorXd& p) {
    const Spectrum stops = form.stops(p, 1);
    VectorXd result(stops.size() + 1);
    for (std::size_t j = 0; j < stops.size(); ++j)
      result[static_cast<int>(j)] = std::log(stops.stiffnesses[j]);
    result[result.size() - 1] = std::log(stops.friction_moment());
    return result;
  };
  Eigen::MatrixXd by(logarithms(parameters).size(), parameters.size());
  for (int i = 0; i < parameters.size(); ++i) {
    const VectorXd step = kStep * VectorXd::Unit(parameters.size(), i);
    by.col(i) = (logarithms(parameters + step) - logarithms(parameters - step)) / (2 * kStep);
  }
  return (by * covariance * by.transpose()).diagonal().cwiseMax(0).cwiseSqrt();
}

}  // namespace hysteron
