// A system's matrix with the membrane's softening and bending's stiffness in it: a product reads the rows of
// one matrix where it would take four loops, one after the other, and twice the bytes.
#pragma once

#include "sim/bending/bending.h"
#include "sim/linear/block_rows.h"
#include "sim/linear/compressed_rows.h"

namespace hysteron {

template <class Real, class Device>
class AssembledStiffness : public DefiniteMatrix<Real> {
 public:
  // Two of an element's vertices, each as an item of its elements' vertices.
  struct Pair {
    int first, second;
  };

  // `rows` and `bending` must outlive it.
  AssembledStiffness(Device& device, const BlockRows<Real, Device>& rows,
                     const Bending<Real, Device>& bending);

  // Of `rows`, softening (null: none) and bending where it was linearised last [N/m].
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
  // How each element's curvature changes with each of its vertices: D rows of three [1/m^2].
  Buffer<int, Device> element_, vertex_;
  Buffer<Real, Device> rate_;
  // For each block its pairs, in the order of their elements, and where it stands in the system's matrix, its
  // diagonal among the diagonals; -1: nowhere.
  Buffer<UpperBlock, Device> upper_;
  Buffer<int, Device> pair_start_, narrow_;
  Buffer<Pair, Device> pair_;
  Buffer<int, Device> row_ptr_, col_;
  Buffer<Mat3<Real>, Device> off_diagonal_, diagonal_;
};

}  // namespace hysteron
