// The implicit solve's matrix: 3x3 blocks, one row per vertex, with the diagonal in an array of its own.
#pragma once

#include <utility>
#include <vector>

#include "sim/device/device.h"
#include "sim/linear/compressed_rows.h"
#include "sim/mesh/cloth_mesh.h"

namespace hysteron {

// A number for every block of a BlockRowsView, which stands for that multiple of the identity.
template <class Real>
struct ScalarRowsView {
  Real* off_diagonal = nullptr;
  Real* diagonal = nullptr;
};

template <class Real>
struct BlockRowsView {
  int rows;            // n
  const int* row_ptr;  // n + 1 starts: the off-diagonal blocks of row i are row_ptr[i] ... row_ptr[i+1]-1
  const int* col;      // the column of each off-diagonal block
  Mat3<Real>* off_diagonal;  // [N/m], as are the diagonal ones
  Mat3<Real>* diagonal;      // n blocks

  HYST_HD Vec3<Real> times(int i, const Vec3<Real>* v) const {
    Vec3<Real> sum = diagonal[i] * v[i];
    for (int j = row_ptr[i]; j < row_ptr[i + 1]; ++j) sum += off_diagonal[j] * v[col[j]];
    return sum;
  }
  // Returns the product with `added` included.
  HYST_HD Vec3<Real> times(int i, const Vec3<Real>* v, const ScalarRowsView<Real>& added) const {
    Vec3<Real> sum = diagonal[i] * v[i] + added.diagonal[i] * v[i];
    for (int j = row_ptr[i]; j < row_ptr[i + 1]; ++j) {
      const Vec3<Real> other = v[col[j]];
      sum += off_diagonal[j] * other + added.off_diagonal[j] * other;
    }
    return sum;
  }
};

template <class Real, class Device>
class BlockRows {
 public:
  // Makes one off-diagonal block for each pair of vertices that share a triangle.
  BlockRows(Device& device, const ClothMesh& mesh) : BlockRows(device, neighbours_in(mesh)) {}
  // Takes the off-diagonal blocks of each row, columns ascending.
  BlockRows(Device& device, Adjacency pattern)
      : pattern_(std::move(pattern)),
        row_ptr_(device, pattern_.start),
        col_(device, pattern_.item),
        off_diagonal_(device, pattern_.item.size()),
        diagonal_(device, pattern_.start.size() - 1) {}

  BlockRowsView<Real> view() {
    return {static_cast<int>(diagonal_.size()), row_ptr_.data(), col_.data(), off_diagonal_.data(),
            diagonal_.data()};
  }
  // Returns the position of block (row, column) among the off-diagonal blocks.
  int slot(int row, int column) const { return slot_in_row(pattern_, row, column); }
  const Adjacency& pattern() const { return pattern_; }
  const std::vector<int>& row_ptr() const { return pattern_.start; }
  const std::vector<int>& col() const { return pattern_.item; }
  std::vector<Mat3<Real>> off_diagonal() const { return off_diagonal_.download(); }
  std::vector<Mat3<Real>> diagonal() const { return diagonal_.download(); }
  std::size_t bytes() const {
    return row_ptr_.bytes() + col_.bytes() + off_diagonal_.bytes() + diagonal_.bytes();
  }

 private:
  Adjacency pattern_;
  Buffer<int, Device> row_ptr_, col_;
  Buffer<Mat3<Real>, Device> off_diagonal_, diagonal_;
};

// Assembles the rows of a system's matrix with bending's stiffness in it, without softening.
template <class Real>
class DefiniteMatrix {
 public:
  virtual ~DefiniteMatrix() = default;
  virtual Adjacency pattern() const = 0;  // the off-diagonal blocks, on the host
  // The result is on the device, valid until the next call.
  virtual BlockRowsView<Real> assemble(const BlockRowsView<Real>& matrix) = 0;
  virtual std::size_t bytes() const = 0;
};

// The matrix of a system to which nothing has to be added.
template <class Real>
class RowsAlone : public DefiniteMatrix<Real> {
 public:
  explicit RowsAlone(Adjacency pattern) : pattern_(std::move(pattern)) {}
  Adjacency pattern() const override { return pattern_; }
  BlockRowsView<Real> assemble(const BlockRowsView<Real>& matrix) override { return matrix; }
  std::size_t bytes() const override { return 0; }

 private:
  Adjacency pattern_;
};

}  // namespace hysteron
