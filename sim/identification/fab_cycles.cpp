#include "sim/identification/fab_cycles.h"

#include <Eigen/Cholesky>
#include <algorithm>

#include "sim/base/error.h"

namespace hysteron {

void check_cycles(const std::vector<FabLoops>& loops, const std::vector<int>& cycles) {
  for (const FabLoops& one : loops)
    for (const int cycle : cycles)
      if (cycle < 1 || cycle > one.cycles())
        throw Error::invalid_input("cycle " + std::to_string(cycle) + " of " + one.name() + " must be 1 to " +
                                   std::to_string(one.cycles()))
            .with_key("fab.cycles", std::to_string(cycle));
}

std::vector<FabRow> branch_rows(const std::vector<FabLoops>& loops, const std::vector<int>& cycles) {
  std::vector<FabRow> rows;
  for (std::size_t l = 0; l < loops.size(); ++l)
    for (const int cycle : cycles)
      for (int b = 2 * cycle - 2; b < 2 * cycle; ++b)
        for (std::size_t i = 0; i < loops[l].branches[b].force.size(); ++i)
          rows.push_back({static_cast<int>(l), b, i, loops[l].branches[b].force[i], 0});
  return rows;
}

Eigen::VectorXd row_residuals(const std::vector<FabLoops>& loops, const std::vector<int>& cycles,
                              const std::vector<FabRow>& rows, const FabStrip& strip,
                              const Eigen::VectorXd& zeros) {
  const int last = *std::max_element(cycles.begin(), cycles.end());
  std::vector<BranchForces> force;
  for (const FabLoops& one : loops) force.push_back(run_fab(one, strip, 2 * last).force);
  Eigen::VectorXd result(rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const FabRow& row = rows[i];
    result[i] = row.weight * (force[row.loops][row.branch][row.index] + zeros[row.loops] - row.force);
  }
  return result;
}

void FabStops::take(const LeastSquares& best, const std::vector<FabLoops>& loops, int fitted_rows) {
  direction = loops[0].direction;
  const Eigen::VectorXd zeros = best.parameters.tail(loops.size());
  zero.assign(zeros.begin(), zeros.end());
  rows = fitted_rows;
  iterations = best.iterations;
  converged = best.converged;
}

void FabStops::set_errors(double of_spring, const Eigen::VectorXd& of_stops) {
  spring_error = of_spring * law.spring;
  determined = {is_determined(of_spring)};
  for (int j = 0; j < law.stops(); ++j) {
    stiffness_errors.push_back(of_stops[j] * law.stiffnesses[j]);
    determined.push_back(is_determined(of_stops[j]));
  }
}

Eigen::MatrixXd posterior(const LeastSquares& best, int rows) {
  const auto parameters = best.jacobian.cols();
  const double free = std::max<double>(1, rows - static_cast<double>(parameters));
  const Eigen::VectorXd left = best.residuals.head(rows);
  const double variance =
      std::max(1.0, left.squaredNorm() / free * rows_as_one(neighbour_correlation(left), rows));
  const Eigen::MatrixXd data = best.jacobian.topRows(rows),
                        prior = best.jacobian.bottomRows(best.jacobian.rows() - rows);
  const Eigen::MatrixXd information = data.transpose() * data / variance + prior.transpose() * prior;
  return information.ldlt().solve(Eigen::MatrixXd::Identity(parameters, parameters));
}

double force_zero(const FabLoops& loops, const BranchForces& model) {
  double sum = 0;
  std::size_t count = 0;
  for (std::size_t b = 0; b < model.size(); ++b)
    for (std::size_t i = 0; i < model[b].size(); ++i, ++count)
      sum += loops.branches[b].force[i] - model[b][i];
  return sum / static_cast<double>(count);
}

}  // namespace hysteron
