// The common part of identification from FAB loops for bending and stretch.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "sim/identification/identification.h"
#include "sim/identification/least_squares.h"
#include "sim/reference/fab_test.h"

namespace hysteron {

// One row that is fitted.
struct FabRow {
  int loops, branch;
  std::size_t index;
  double force, weight;  // force [N/m]; weight over the noise [m/N]
};

// Throws Error::invalid_input unless all loops have the cycles, the first being 1.
void check_cycles(const std::vector<FabLoops>& loops, const std::vector<int>& cycles);

// Returns the rows of all branches of these cycles, without a weight yet.
std::vector<FabRow> branch_rows(const std::vector<FabLoops>& loops, const std::vector<int>& cycles);

// Returns the forces of such a strip, with the zeros of the loops added, less those of the rows, over the
// noise.  Throws as run_fab() does.
Eigen::VectorXd row_residuals(const std::vector<FabLoops>& loops, const std::vector<int>& cycles,
                              const std::vector<FabRow>& rows, const FabStrip& strip,
                              const Eigen::VectorXd& zeros);

// The stops beside a spring that loops of one direction identify.
struct FabStops {
  std::string direction;
  StopsLaw law;
  // Standard errors; those of stiffnesses, whose logarithms are sought, are that of the logarithm times the
  // value.
  double spring_error = kNone;
  std::vector<double> stiffness_errors;
  std::vector<bool> determined;  // for the spring, then for each stop
  std::vector<double> zero;      // of force, for each fitted loop [N/m]
  int rows = 0, iterations = 0;
  bool converged = false;

  // Takes all results except the law and its errors; the zeros are the last parameters.
  void take(const LeastSquares& best, const std::vector<FabLoops>& loops, int fitted_rows);
  // Sets errors from standard errors of the logarithms of the spring and, from the first on, of the stops'
  // stiffnesses.
  void set_errors(double of_spring, const Eigen::VectorXd& of_stops);
};

// Returns the covariance of the parameters after least squares over `rows` rows, weighted by their noise,
// followed by the distances from a prior: by the noise or, where rows scatter by more, by that scatter;
// correlated rows count as fewer (least_squares.h).
Eigen::MatrixXd posterior(const LeastSquares& best, int rows);

// Returns the constant that brings a model's forces nearest to the measured ones, all rows alike [N/m].
double force_zero(const FabLoops& loops, const BranchForces& model);

}  // namespace hysteron
