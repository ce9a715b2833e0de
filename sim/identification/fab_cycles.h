// What identification from FAB loops shares between bending and stretch.
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
  double force, weight;  // [N/m]; over the noise [m/N]
};

// Throws Error::invalid_input unless all loops have the cycles, the first being 1.
void check_cycles(const std::vector<FabLoops>& loops, const std::vector<int>& cycles);

// Of all branches of these cycles, without a weight yet.
std::vector<FabRow> branch_rows(const std::vector<FabLoops>& loops, const std::vector<int>& cycles);

// Distances of the forces of such a strip, with the zeros of the loops added, from those of the rows, over
// the noise.  Throws as run_fab().
Eigen::VectorXd row_residuals(const std::vector<FabLoops>& loops, const std::vector<int>& cycles,
                              const std::vector<FabRow>& rows, const FabStrip& strip,
                              const Eigen::VectorXd& zeros);

// Stops beside a spring that loops of one direction identify.
struct FabStops {
  std::string direction;
  StopsLaw law;
  // Standard errors: of stiffnesses, whose logarithms are sought, that of the logarithm times the value.
  double spring_error = kNone;
  std::vector<double> stiffness_errors;
  std::vector<bool> determined;  // of the spring, then of each stop
  std::vector<double> zero;      // of force, by fitted loops [N/m]
  int rows = 0, iterations = 0;
  bool converged = false;

  // All but the law and what is known of it: the zeros are the last parameters.
  void take(const LeastSquares& best, const std::vector<FabLoops>& loops, int fitted_rows);
  // From standard errors of the logarithms of the spring and, first of these, of the stops' stiffnesses.
  void set_errors(double of_spring, const Eigen::VectorXd& of_stops);
};

// Covariance of the parameters after least squares over `rows` rows, weighted by their noise, and the
// distances from a prior behind them: by the noise or, where rows scatter by more, by that scatter; rows that
// hang together count as fewer (least_squares.h).
Eigen::MatrixXd posterior(const LeastSquares& best, int rows);

// What has to be added to a model's forces to meet the measured ones best, all rows alike [N/m].
double force_zero(const FabLoops& loops, const BranchForces& model);

}  // namespace hysteron
