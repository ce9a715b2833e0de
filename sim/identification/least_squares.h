// Nonlinear least squares with bounds, by Ceres (Agarwal, Mierle and the Ceres Solver team).
#pragma once

#include <Eigen/Core>
#include <functional>

namespace hysteron {

struct LeastSquares {
  Eigen::VectorXd parameters;
  Eigen::VectorXd residuals;  // at the solution
  Eigen::MatrixXd jacobian;   // there: rows = residuals, columns = parameters
  int iterations = 0;         // steps of Levenberg and Marquardt that were tried
  bool converged = false;
};

// Residuals at given parameters; always as many.  Smooth, of order one, in parameters of
// order one; not a number where the model has no meaning.
using Residuals = std::function<Eigen::VectorXd(const Eigen::VectorXd&)>;

// Least sum of squares from `start` within [low, high] (all of one length, at least one parameter).
LeastSquares minimize(const Residuals& residuals, const Eigen::VectorXd& start, const Eigen::VectorXd& low,
                      const Eigen::VectorXd& high);

}  // namespace hysteron
