// Inverts the coarsest level's matrix, where a multigrid cycle turns.
#pragma once

#include <Eigen/LU>
#include <limits>

#include "sim/linear/cycle.h"

namespace hysteron {

// Returns the inverse of a symmetric positive semidefinite block; a direction whose stiffness is mere
// rounding gets the stiffness of the rounding.  A zero block, which belongs to a node that nothing moves,
// yields zero.
template <class Real>
HYST_HD inline Mat3<Real> safe_inverse(const Mat3<Real>& block) {
  const Real trace = block(0, 0) + block(1, 1) + block(2, 2);
  if (!(trace > 0)) return Mat3<Real>::Zero();
  Mat3<Real> scaled = block / trace;
  for (int k = 0; k < 3; ++k) scaled(k, k) += 2 * std::numeric_limits<Real>::epsilon();
  const Mat3<Real> inverse = scaled.inverse();  // apart: in an expression Eigen would use host code
  return inverse / trace;
}

// The inverse of a symmetric positive semidefinite matrix.  It is undefined for nodes that nothing moves;
// they get no forces.
template <class Real, class Device>
class DenseInverse;

// Inverts block by block, in double, for few nodes.
template <class Real>
class DenseInverse<Real, Cpu> {
 public:
  // A level of up to enough() nodes is inverted rather than coarsened; one that cannot be coarsened well, up
  // to most().
  static int enough(const Cpu&) { return 24; }
  static int most(const Cpu&) { return 96; }

  DenseInverse(Cpu& cpu, int nodes)
      : nodes_(nodes), blocks_(cpu, nodes * nodes), next_(cpu, nodes * nodes), pivot_(cpu, nodes) {}

  void make(Cpu& cpu, const BlockRowsView<Real>& matrix) {
    for_each(cpu, kernel(), nodes_ * nodes_, [&](int e) { put(blocks_, e, matrix_block(matrix, e), 0); });
    for (int k = 0; k < nodes_; ++k) {
      for_each(cpu, kernel(), nodes_ * nodes_, [&](int e) { put(next_, e, eliminated(k, e), k + 1); });
      std::swap(blocks_, next_);
    }
  }
  // Sets y = inverse b, both of n nodes.
  void apply(Cpu& cpu, const Vec3<Real>* b, Vec3<Real>* y, const int* /*stop*/) {
    const Eigen::Matrix3d* inverse = blocks_.data();
    const int n = nodes_;
    for_each(cpu, {"multigrid: dense solve", blocks_.bytes() + 2 * n * sizeof(Vec3<Real>)}, n, [=](int i) {
      Eigen::Vector3d sum = Eigen::Vector3d::Zero();
      for (int j = 0; j < n; ++j) sum += inverse[j * n + i].transpose() * b[j].template cast<double>();
      y[i] = sum.template cast<Real>();
    });
  }
  double refactor_threshold() const { return 0; }  // iterations of a solve that take about as long as make()
  std::size_t bytes() const { return blocks_.bytes() + next_.bytes() + pivot_.bytes(); }

 private:
  using Blocks = Buffer<Eigen::Matrix3d, Cpu>;
  Kernel kernel() const { return {"multigrid: dense inverse", 2 * blocks_.bytes()}; }

  Eigen::Matrix3d matrix_block(const BlockRowsView<Real>& matrix, int e) const {
    const int i = e / nodes_, column = e % nodes_;
    if (i == column) return matrix.diagonal[i].template cast<double>();
    for (int j = matrix.row_ptr[i]; j < matrix.row_ptr[i + 1]; ++j)
      if (matrix.col[j] == column) return matrix.off_diagonal[j].template cast<double>();
    return Eigen::Matrix3d::Zero();
  }
  // Returns a block after Gauss-Jordan elimination without exchange of rows.
  Eigen::Matrix3d eliminated(int k, int e) const {
    const int n = nodes_, i = e / n, j = e % n;
    const Eigen::Matrix3d *a = blocks_.data(), *pivot = pivot_.data();
    if (i == k) return j == k ? pivot[k] : Eigen::Matrix3d(pivot[k] * a[e]);
    if (j == k) return -a[e] * pivot[k];
    return a[e] - a[i * n + k] * (pivot[k] * a[k * n + j]);
  }
  // Whoever finishes a pivot block inverts it.
  void put(Blocks& to, int e, const Eigen::Matrix3d& block, int next_pivot) {
    to.data()[e] = block;
    if (e == next_pivot * nodes_ + next_pivot) pivot_.data()[next_pivot] = safe_inverse<double>(block);
  }

  int nodes_;
  Blocks blocks_, next_;  // row by row, before and after a pivot
  Blocks pivot_;          // the inverse of each pivot
};

}  // namespace hysteron

#ifdef __CUDACC__
#include "sim/linear/dense_tiles.h"
#endif
