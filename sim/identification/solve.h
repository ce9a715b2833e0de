// b1, b2 and k0 of a measured series, what it leaves open, and what is assumed then.
#pragma once

#include "sim/identification/identification.h"
#include "sim/identification/least_squares.h"
#include "sim/identification/model.h"
#include "sim/scene/key_table.h"

namespace hysteron {

struct Interval {
  double low = kInfinity, high = 0;
  void include(double x);
  bool narrow() const { return high <= kWidestFactor * low; }
};

struct Solution {
  CurvePoint best;
  CurvePoint used;        // best, or best under an assumption
  Covariance covariance;  // of MomentModel::parameters() at the best
  Eigen::VectorXd residuals;
  Eigen::MatrixXd jacobian;  // by MomentModel::parameters()
  int iterations = 0;
  Interval b1, b2, k0;     // what the scan allows (95 %)
  bool k0_open = false;    // up to its end
  Eigen::Vector3d errors;  // standard errors of the logarithms of b1, b2, k0, with their floor

  // Twice the logarithm of the likelihood ratio between the best and another sum of squares.
  double fall(double sum) const;
  // By how much it would rise with a constant added to all residuals (score test; Rao 1948).
  double rise_with_offset() const;
  double noise = 0;  // variance of a residual, at least that of kBestAccuracy
};

// Least squares: a scan over k0 (on which alone the shape depends, so that it finds the best valley and shows
// which k0 the data exclude), then all parameters together.
Solution solve(const MomentModel& model);

// Numbers with standard errors into `result`.  A number is undetermined if the scan's interval or the
// standard error's (from the singular values of the scaled Jacobian) is wider than kWidestFactor; where an
// assumption then describes the data as well, it is taken, and Solution::used with it. `source` is noted for
// what is fitted.
void identify(const MomentModel& model, const Assumptions& assumptions, const std::string& source,
              Solution& solution, Identification& result);

}  // namespace hysteron
