// Solves nonlinear least squares with bounds, by Ceres (Agarwal, Mierle and the Ceres Solver team), and
// linear ones, by Eigen.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <functional>

namespace hysteron {

struct LeastSquares {
  Eigen::VectorXd parameters;
  Eigen::VectorXd residuals;  // at the solution
  Eigen::MatrixXd jacobian;   // at the solution: rows = residuals, columns = parameters
  int iterations = 0;         // trial steps of Levenberg and Marquardt
  bool converged = false;

  // Returns the sum of squared residuals; infinite where the model has no meaning.
  double sum() const { return residuals.allFinite() ? residuals.squaredNorm() : INFINITY; }
};

// Returns the residuals at given parameters, always equally many; they are smooth and of order one, for
// parameters of order one, and NaN where the model has no meaning.
using Residuals = std::function<Eigen::VectorXd(const Eigen::VectorXd&)>;

// The limits at which a search ends.
struct SearchLimits {
  int iterations = 500;
  double change = 1e-12;  // relative, of the sum of squares in an iteration
  int halvings = 20;      // the most halvings of a step that does not lower it
};

// Minimises the sum of squares from `start` within [low, high] (all of one length, at least one parameter).
LeastSquares minimize(const Residuals& residuals, const Eigen::VectorXd& start, const Eigen::VectorXd& low,
                      const Eigen::VectorXd& high, SearchLimits limits = {});

// Has `a` found another, deeper minimum than `b`? Residuals are over their noise.
bool is_deeper(const LeastSquares& a, const LeastSquares& b);

// Returns the shortest x with the least |a x - b|, one number per column of a.
Eigen::VectorXd linear_least_squares(const Eigen::MatrixXd& a, const Eigen::VectorXd& b);

// The covariance tells how well residuals fix parameters; it follows from the singular values of the scaled
// Jacobian.

// No measured curve is more accurate than this share of its largest moment; exact data are judged by it.
inline constexpr double kBestAccuracy = 1e-3;

// Returns the correlation of neighbours among numbers whose mean is about zero; 0 for fewer than three, and
// for rounding.
double neighbour_correlation(const Eigen::VectorXd& residuals);
// Returns how many of `rows` rows count as one where neighbours have that correlation, taken as that of a
// first-order process: (1 + r)/(1 - r); 1 where the correlation may be chance.
double rows_as_one(double correlation, int rows);

struct Covariance {
  Eigen::MatrixXd matrix;      // covariance of the parameters, from the scatter of the residuals
  Eigen::MatrixXd with_floor;  // at least that of noise kBestAccuracy: decides what is determined
  double correlation = 0;      // correlation of neighbouring residuals
  double widening = 1;         // factor on standard errors for that correlation; included above
};

// Computes the covariance from residuals (scaled to a largest moment of 1) and their Jacobian at the optimum,
// with at least as many rows as parameters.  Errors may differ from row to row (MacKinnon & White 1985, HC2);
// correlation between neighbours is taken as that of a first-order process, which leaves n (1 - r)/(1 + r)
// independent rows.  Directions that the residuals do not see get a large, finite variance.  `is_even`:
// errors are taken as the same in all rows.
Covariance covariance(const Eigen::MatrixXd& jacobian, const Eigen::VectorXd& residuals,
                      bool is_even = false);

// Is a positive quantity with this standard error of its logarithm known within kWidestFactor (95 %)?
bool is_determined(double relative_error);

}  // namespace hysteron
