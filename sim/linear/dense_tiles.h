// The dense inverse on a GPU treats a symmetric matrix of some hundred nodes as a front of which every row is
// swept.  Rows and columns are scaled to a diagonal of ones.  Included by dense_inverse.h, under nvcc only.
#pragma once

#include "sim/linear/front_sweeps.h"

namespace hysteron {

// Writes a row of blocks, left of the diagonal, into the dense matrix.
template <class Real>
struct DenseBlocks {
  BlockRowsView<Real> matrix;
  const double* scale;
  double* number;
  int stride;

  __device__ void operator()(int i, const Warp& lanes) const {
    if (lanes.leads()) put(i, i, matrix.diagonal[i]);
    for (int j = matrix.row_ptr[i] + lanes.index(); j < matrix.row_ptr[i + 1]; j += Warp::kCount)
      if (matrix.col[j] < i) put(i, matrix.col[j], matrix.off_diagonal[j]);
  }
  __device__ void put(int i, int j, const Mat3<Real>& block) const {
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c) {
        const int row = 3 * i + r, column = 3 * j + c;
        if (row > column)
          number[static_cast<std::size_t>(row) * stride + column] =
              static_cast<double>(block(r, c)) * scale[row] * scale[column];
      }
  }
};

template <class Real>
class DenseInverse<Real, Cuda> {
 public:
  // A level of 512 nodes takes a sixth of an H100's cache; graphics GPUs are slow in double precision.
  static int enough(const Cuda& cuda) { return most(cuda); }
  static int most(const Cuda& cuda) {
    constexpr int kWhereDoubleIsFast = 512, kElsewhere = 96;
    int ratio = 0;
    check_cuda(cudaDeviceGetAttribute(&ratio, cudaDevAttrSingleToDoublePrecisionPerfRatio, cuda.index),
               "double precision");
    return ratio <= 2 ? kWhereDoubleIsFast : kElsewhere;
  }

  DenseInverse(Cuda& cuda, int nodes)
      : rows_(3 * nodes),
        tiles_((rows_ + kTile - 1) / kTile),
        matrix_(cuda, static_cast<std::size_t>(stride()) * stride()),
        scratch_(cuda, SweptFront::scratch_of(tiles_)),
        scale_(cuda, stride()) {}

  void make(Cuda& cuda, const BlockRowsView<Real>& matrix) {
    fill(cuda, matrix);
    const OneFront front{{matrix_.data(), tiles_, tiles_, scratch_.data()}};
    sweep_fronts<Real>(cuda, front, tiles_, tiles_, {"multigrid: dense inverse", matrix_.bytes()});
    finish(cuda);
  }
  void apply(Cuda& cuda, const Vec3<Real>* b, Vec3<Real>* y, const int* stop) {
    for_each_row(cuda, {"multigrid: dense solve", matrix_.bytes() + 2 * rows_ * sizeof(Real)}, rows_,
                 row(b, y), stop);
  }
  DenseRow<Real> row(const Vec3<Real>* b, Vec3<Real>* y) const {
    return {matrix_.data(), stride(), rows_, b->data(), y->data()};
  }
  // This is half of the iterations that take as long as make(), since several solves may take them.
  double refactor_threshold() const { return tiles_ / 4.0; }
  std::size_t bytes() const { return total_bytes(matrix_, scratch_, scale_); }

  // The parts of make(); public because nvcc allows no device lambda in a private member function.
  // fill() sets the lower triangle, scaled; the diagonal is ones, even for nodes that nothing moves.
  void fill(Cuda& cuda, const BlockRowsView<Real>& matrix) {
    double *number = matrix_.data(), *scale = scale_.data();
    const int rows = rows_, width = stride();
    for_each(
        cuda, {"multigrid: dense ones", matrix_.bytes()}, width * width, HYST_KERNEL(int e) {
          const int row = e / width;
          number[e] = row == e % width;
          if (e >= width) return;
          const double diagonal = e < rows ? static_cast<double>(matrix.diagonal[e / 3](e % 3, e % 3)) : 1.0;
          scale[e] = diagonal > 0 ? 1 / sqrt(diagonal) : 1.0;
        });
    for_each_row(cuda, {"multigrid: dense blocks"}, matrix.rows,
                 DenseBlocks<Real>{matrix, scale, number, width});
  }
  // Completes both triangles of the inverse.
  void finish(Cuda& cuda) {
    double* number = matrix_.data();
    const double* scale = scale_.data();
    const int rows = rows_, width = stride();
    for_each(
        cuda, {"multigrid: dense symmetry", 2 * matrix_.bytes()}, rows * width, HYST_KERNEL(int e) {
          const int i = e / width, j = e % width;
          if (j > i) return;
          const double inverse = -number[e] * scale[i] * scale[j];
          number[e] = inverse;
          number[static_cast<std::size_t>(j) * width + i] = inverse;
        });
  }

 private:
  int stride() const { return tiles_ * kTile; }

  int rows_, tiles_;
  Buffer<double, Cuda> matrix_;
  Buffer<double, Cuda> scratch_;  // for the sweeps
  Buffer<double, Cuda> scale_;
};

}  // namespace hysteron
