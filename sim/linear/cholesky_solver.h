// Conjugate gradients preconditioned by a Cholesky factorisation of the whole matrix, on the CPU: mass,
// membrane and contact, and bending and self-contact, which the products apply element by element.
//
// A new factorisation solves a system in an iteration or two.  It is kept while it is worth it: the next
// systems of Newton's method differ little, and where more iterations have been taken with it than a new one
// would cost, or a system has not been solved after as many, the next system gets a new one.  What the
// membrane's softening takes away is left out, so that the factorisation is that of a positive definite
// matrix, and conjugate gradients find directions of negative curvature as with any other preconditioner.
#pragma once

#include <memory>
#include <optional>

#include "sim/linear/elimination.h"
#include "sim/linear/linear_solver.h"

namespace hysteron {

// Sparse Cholesky factorisation of a symmetric positive definite matrix of 3x3 blocks, front by front (Duff &
// Reid 1983; Liu 1992): A = L L^T.  On one thread, in one order: the same bits whatever the number of
// threads.
class SparseCholesky {
 public:
  explicit SparseCholesky(const Couplings& couplings);

  // The matrix must have the couplings of the constructor.  A pivot that rounding leaves without a digit, as
  // of a matrix that is singular, is replaced by the matrix's own diagonal number: L L^T is then another
  // matrix, positive definite all the same.  Returns how many were.
  int factorise(const SymmetricBlocks& matrix);
  // L L^T x = x, three numbers a node.
  void solve(double* x) const;

  const Elimination& plan() const { return plan_; }
  std::size_t bytes() const;

 private:
  void assemble(const Front& front, const SymmetricBlocks& matrix, double* panel) const;
  void take_over(const Front& child, const Front& front, const double* update, double* panel,
                 double* remainder) const;

  Elimination plan_;
  std::vector<double> factor_, updates_, least_pivot_;
  mutable std::vector<double> ordered_, front_;  // scratch of solve()
};

template <class Real>
class CholeskySolver : public LinearSolver<Real, Cpu>, private Preconditioner<Real, Cpu> {
 public:
  using System = LinearSystem<Real, Cpu>;

  // The stiffnesses of bending and self-contact, null where a system has none.
  CholeskySolver(Cpu& device, const BlockRows<Real, Cpu>& pattern, std::unique_ptr<ElementStiffness> bending,
                 std::unique_ptr<ElementStiffness> self_contact);

  PcgOutcome solve(const System& system, const char* held, const Vec3<Real>* rhs, Vec3<Real>* x,
                   double tolerance) override;
  // The factorisation as the matrix it is of, which later solves go on with.
  void serialise(Archive& archive) override;
  std::size_t bytes() const override;

  long factorisations() const { return factorisations_; }  // since the start

 private:
  void apply(const Vec3<Real>* r, Vec3<Real>* z, PcgScalars* scalars) override;
  void renew(const System& system, const char* held);
  bool contact_is_coupled() const;
  void couple_contact();
  void take_couplings(Couplings couplings);
  void assemble(const BlockRowsView<Real>& rows, const char* held);
  int worth() const;

  Cpu& device_;
  Pcg<Real, Cpu> pcg_;
  std::unique_ptr<ElementStiffness> bending_, self_contact_;
  Adjacency pattern_;  // of the systems' matrices
  Couplings always_;   // of these and of bending
  std::vector<int> row_slot_, bending_slot_;
  SymmetricBlocks matrix_;  // of which the factorisation is
  std::optional<SparseCholesky> factor_;
  std::vector<char> held_;  // when it was made; empty: there is none
  int spent_ = 0;           // iterations with it that a new one would have saved
  long factorisations_ = 0;
  std::vector<double> values_;  // scratch of apply()
};

}  // namespace hysteron
