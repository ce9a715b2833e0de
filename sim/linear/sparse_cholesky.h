// Sparse Cholesky factorisation of a symmetric positive definite matrix of 3x3 blocks, front by front (Duff &
// Reid 1983; Liu 1992), on the CPU: A = L L^T.  It runs on one thread, in one order, so that the bits do not
// depend on the number of threads.
#pragma once

#include "sim/linear/elimination.h"

namespace hysteron {

class SparseCholesky {
 public:
  explicit SparseCholesky(const SparsityPattern& couplings);

  // Factorises a matrix with the couplings of the constructor.  A pivot that rounding leaves without a digit,
  // as in a singular matrix, is replaced by the matrix's own diagonal number: L L^T is then another matrix,
  // but positive definite.  Returns how many pivots were replaced.
  int factorise(const SymmetricBlocks& matrix);
  // Solves L L^T x = x in place, n x 3 numbers in the order of the nodes.
  void solve(double* x) const;

  const SymbolicFactorization& plan() const { return plan_; }
  std::size_t bytes() const;

 private:
  void assemble(const Front& front, const SymmetricBlocks& matrix, double* panel) const;
  void extend_add(const Front& child, const Front& front, const double* update, double* panel,
                  double* remainder) const;

  SymbolicFactorization plan_;
  std::vector<double> factor_, updates_, least_pivot_;
  mutable std::vector<double> ordered_, front_;  // scratch of solve()
};

}  // namespace hysteron
