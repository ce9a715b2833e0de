// The CPU's factorisation for CholeskySolver, assembled on the host from the matrix's rows, bending element
// by element, self-contact pair by pair.
#pragma once

#include <memory>
#include <optional>

#include "sim/linear/cholesky_solver.h"
#include "sim/linear/sparse_cholesky.h"

namespace hysteron {

template <class Real>
class SparseFactorisation : public Factorisation<Real, Cpu> {
 public:
  // Takes the stiffness of bending, null where systems have none.
  SparseFactorisation(Cpu& device, const BlockRows<Real, Cpu>& pattern,
                      std::unique_ptr<ElementStiffness> bending);

  void renew(const LinearSystem<Real, Cpu>& system, const char* held) override;
  int refactor_threshold() const override;
  void apply(const Vec3<Real>* r, Vec3<Real>* z, PcgScalars* scalars) override;
  void serialise(Archive& archive, const std::vector<char>& held) override;
  std::size_t bytes() const override;

 private:
  bool are_coupled(const PairProduct<Real>& pairs) const;
  void couple(const PairProduct<Real>& pairs);
  void take_couplings(SparsityPattern couplings);
  void assemble(const LinearSystem<Real, Cpu>& system, const char* held);

  Cpu& device_;
  std::unique_ptr<ElementStiffness> bending_;
  Adjacency pattern_;       // of the systems' matrices
  SparsityPattern always_;  // of the pattern and of bending
  std::vector<int> row_slot_, bending_slot_;
  SymmetricBlocks matrix_;  // the factorised matrix
  std::optional<SparseCholesky> factor_;
  std::vector<char> held_;      // when it was made
  std::vector<double> values_;  // scratch of apply()
};

}  // namespace hysteron
