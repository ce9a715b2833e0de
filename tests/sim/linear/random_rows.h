// Matrices of tests.
#pragma once

#include <Eigen/Core>
#include <random>
#include <vector>

#include "sim/linear/block_rows.h"

namespace hysteron::test {

// A symmetric matrix on a mesh's edges with random blocks off its diagonal, `diagonal` times the identity on
// it, and a random right-hand side; the same each time.
inline void fill_at_random(BlockRows<double, Cpu>& rows, double diagonal, std::vector<Vec3<double>>& rhs) {
  std::mt19937 generator(3);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const BlockRowsView<double> view = rows.view();
  for (int i = 0; i < view.rows; ++i) {
    view.diagonal[i] = diagonal * Mat3<double>::Identity();
    rhs[i] = {uniform(generator), uniform(generator), uniform(generator)};
    for (int j = view.row_ptr[i]; j < view.row_ptr[i + 1]; ++j) {
      if (view.col[j] > i) continue;
      Mat3<double> block;
      for (double& b : block.reshaped()) b = uniform(generator);
      view.off_diagonal[j] = block;
      view.off_diagonal[rows.slot(view.col[j], i)] = block.transpose();
    }
  }
}

}  // namespace hysteron::test
