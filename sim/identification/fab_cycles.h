// What identification from FAB loops shares between bending and stretch.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "sim/identification/least_squares.h"
#include "sim/reference/fab_loops.h"

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

// Covariance of the parameters after least squares over `rows` rows, weighted by their noise, and the
// distances from a prior behind them: by the noise or, where rows scatter by more, by that scatter.
Eigen::MatrixXd posterior(const LeastSquares& best, int rows);

// What has to be added to a model's forces to meet the measured ones best, all rows alike [N/m].
double force_zero(const FabLoops& loops, const BranchForces& model);

}  // namespace hysteron
