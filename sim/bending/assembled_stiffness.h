// A system's matrix into which the membrane's softening and bending's stiffness are added: a product then
// reads the rows of one matrix where it would take four loops, one after the other, and twice the bytes.
#pragma once

#include "sim/bending/bending.h"
#include "sim/linear/block_rows.h"
#include "sim/linear/compressed_rows.h"

namespace hysteron {

template <class Real, class Device>
class AssembledStiffness : public DefiniteMatrix<Real> {
 public:
  // Two vertices of an element, each as an index into its list of vertices.
  struct Pair {
    int first, second;
  };

  // `rows` and `bending` must outlive it.
  AssembledStiffness(Device& device, const BlockRows<Real, Device>& rows,
                     const Bending<Real, Device>& bending);

  // Adds up the values of `rows`, softening (null: none) and bending's stiffness where it was linearised last
  // [N/m].
  BlockRowsView<Real> assemble(const BlockRowsView<Real>& matrix, const ScalarRowsView<Real>& softening);
  BlockRowsView<Real> assemble(const BlockRowsView<Real>& matrix) override { return assemble(matrix, {}); }
  Adjacency pattern() const override { return {row_ptr_.download(), col_.download()}; }
  std::size_t blocks() const { return off_diagonal_.size(); }  // off the diagonal
  std::size_t matrix_bytes() const { return total_bytes(row_ptr_, col_, off_diagonal_, diagonal_); }
  std::size_t bytes() const override;

  // The parts of assemble(); public because nvcc allows no device lambda in a private member function.
  template <int D>
  void find_rates(const BendingFactors<Real>& factors);
  template <int D>
  void add_up(const BendingFactors<Real>& factors, const BlockRowsView<Real>& matrix,
              const ScalarRowsView<Real>& softening);

 private:
  Device& device_;
  const Bending<Real, Device>& bending_;
  // The rate of each element's curvature by each of its vertices: D rows of three [1/m^2].
  Buffer<int, Device> element_, vertex_;
  Buffer<Real, Device> rate_;
  // For each block: its pairs, in the order of their elements, and its place in the system's matrix (among
  // the diagonals for a diagonal block); -1: it has none.
  Buffer<UpperBlock, Device> upper_;
  Buffer<int, Device> pair_start_, narrow_;
  Buffer<Pair, Device> pair_;
  Buffer<int, Device> row_ptr_, col_;
  Buffer<Mat3<Real>, Device> off_diagonal_, diagonal_;
};

}  // namespace hysteron
