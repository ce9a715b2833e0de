// How well residuals fix parameters: covariance from the singular values of the scaled Jacobian.
#pragma once

#include <Eigen/Core>

namespace hysteron {

// No measured curve is more accurate than this share of its largest moment; exact data are judged by it.
inline constexpr double kBestAccuracy = 1e-3;

struct Covariance {
  Eigen::MatrixXd matrix;      // of the parameters, from the scatter of the residuals
  Eigen::MatrixXd with_floor;  // the same, at least that of noise kBestAccuracy: decides what is determined
  double correlation = 0;      // of neighbouring residuals
  double widening = 1;         // factor on standard errors for that correlation; included above
};

// Residuals (scaled to a largest moment of 1) and their Jacobian at the optimum, at least as many rows as
// parameters.  Errors may differ from row
// to row (MacKinnon & White 1985, HC2); correlation between neighbours is taken as that of a first-order
// process, which leaves n (1 - r)/(1 + r) independent rows.  Directions that the residuals do not see get a
// large, finite variance.
Covariance covariance(const Eigen::MatrixXd& jacobian, const Eigen::VectorXd& residuals);

// Is a positive quantity with this standard error of its logarithm known within kWidestFactor (95 %)?
bool is_determined(double relative_error);

}  // namespace hysteron
