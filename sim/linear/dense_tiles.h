// The dense inverse on a GPU: a symmetric matrix of some hundred nodes is swept (Goodnight 1979: a tutorial
// on the sweep operator) a tile of rows at a time, of which the lower triangle is kept.  With pivot tile P,
// its column C and every other tile A_ij:
//
//   A_ij <- A_ij - C_i P^-1 C_j^T     C_i <- C_i P^-1     P <- -P^-1
//
// makes -A^-1 once every tile was the pivot.  Each pivot takes two launches.  Rows and columns are scaled to
// a diagonal of ones.  Included by dense_inverse.h, under nvcc only.
#pragma once

#include <algorithm>

#include "sim/device/rows.h"

namespace hysteron {

// Rows of a tile, which a block of kThreadsPerBlock threads takes.
inline constexpr int kTile = 32;

// In shared memory; the padding keeps a column's numbers in different banks.
struct Tile {
  double at[kTile][kTile + 1];

  template <class Visit>
  static __device__ void for_each(const Visit& visit) {
    for (int e = threadIdx.x; e < kTile * kTile; e += kThreadsPerBlock) visit(e / kTile, e % kTile);
  }
};

// The lower triangle of a symmetric matrix in whole tiles.
struct TiledMatrix {
  double* number;  // row by row
  int stride;      // numbers of a row

  // Of tile (i, j), which is the transpose of (j, i).
  __device__ double& at(int i, int j, int row, int column) const {
    return i >= j ? entry(i, j, row, column) : entry(j, i, column, row);
  }

 private:
  __device__ double& entry(int i, int j, int row, int column) const {
    return number[static_cast<std::size_t>(i * kTile + row) * stride + j * kTile + column];
  }
};

// Each thread's part of a b^T: two rows, four columns.
struct TileProduct {
  double sum[2][4] = {};

  static __device__ int row(int h) { return threadIdx.x / 8 + 16 * h; }
  static __device__ int column(int m) { return threadIdx.x % 8 + 8 * m; }

  __device__ TileProduct(const Tile& a, const Tile& b) {
    for (int q = 0; q < kTile; ++q) {
      double left[2], right[4];
      for (int h = 0; h < 2; ++h) left[h] = a.at[row(h)][q];
      for (int m = 0; m < 4; ++m) right[m] = b.at[column(m)][q];
      for (int h = 0; h < 2; ++h)
        for (int m = 0; m < 4; ++m) sum[h][m] = fma(left[h], right[m], sum[h][m]);
    }
  }
  template <class Visit>
  __device__ void for_each(const Visit& visit) const {
    for (int h = 0; h < 2; ++h)
      for (int m = 0; m < 4; ++m) visit(row(h), column(m), sum[h][m]);
  }
};

// Of a positive definite tile's lower triangle, by a block of threads: four take a row together.
template <class Real>
__device__ void invert(const Tile& tile, double* inverse) {
  constexpr int kColumnsPerThread = kTile / 4;
  // A direction without stiffness beyond rounding gets that of the rounding; the diagonal was 1.
  constexpr double kMin = 2 * std::numeric_limits<Real>::epsilon();
  __shared__ double shared_column[2][kTile], shared_inverse[2];
  const int row = threadIdx.x / 4, first = threadIdx.x % 4 * kColumnsPerThread;
  double a[kColumnsPerThread];
  for (int c = 0; c < kColumnsPerThread; ++c) a[c] = tile.at[max(row, first + c)][min(row, first + c)];
  for (int part = 0; part < 4; ++part)
#pragma unroll
    for (int q = 0; q < kColumnsPerThread; ++q) {
      const int pivot = part * kColumnsPerThread + q;
      double* column = shared_column[q % 2];
      if (threadIdx.x % 4 == part) {
        column[row] = a[q];
        if (row == pivot) shared_inverse[q % 2] = 1 / max(a[q], kMin);
      }
      __syncthreads();
      const double inverse_pivot = shared_inverse[q % 2], mine = column[row] * inverse_pivot;
      for (int c = 0; c < kColumnsPerThread; ++c) {
        const double other = column[first + c];
        const bool in_column = first + c == pivot;
        if (row == pivot)
          a[c] = in_column ? -inverse_pivot : other * inverse_pivot;
        else
          a[c] = in_column ? mine : fma(-mine, other, a[c]);
      }
    }
  for (int c = 0; c < kColumnsPerThread; ++c) inverse[row * kTile + first + c] = -a[c];
}

// A row of blocks, left of the diagonal.
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

// C of a pivot is kept beside the matrix, which gets C P^-1; the pivot's inverse is known.
struct SweptColumn {
  unsigned blocks;  // the matrix's rows of tiles
  TiledMatrix matrix;
  int pivot;
  const double* inverse;
  double* column;

  __device__ void operator()() const {
    const int i = blockIdx.x, k = pivot;
    if (i == k) return Tile::for_each([&](int r, int c) { matrix.at(k, k, r, c) = -inverse[r * kTile + c]; });
    __shared__ Tile old, by;
    Tile::for_each([&](int r, int c) {
      const double number = i > k ? matrix.at(i, k, r, c) : matrix.at(k, i, r, c);
      (i > k ? old.at[r][c] : old.at[c][r]) = number;
      by.at[r][c] = inverse[r * kTile + c];
    });
    __syncthreads();
    Tile::for_each([&](int r, int c) { column[(i * kTile + r) * kTile + c] = old.at[r][c]; });
    TileProduct(old, by).for_each([&](int r, int c, double sum) { matrix.at(i, k, r, c) = sum; });
  }
};

// All other tiles; then the next pivot is inverted.  A pivot of -1: nothing but that.
template <class Real>
struct SweptRest {
  unsigned blocks;  // tiles of the lower triangle
  TiledMatrix matrix;
  int pivot;
  const double* column;
  double* inverse;

  __device__ void operator()() const {
    int i = static_cast<int>((sqrtf(8.0f * blockIdx.x + 1) - 1) / 2);
    while (i * (i + 1) / 2 > static_cast<int>(blockIdx.x)) --i;
    while ((i + 1) * (i + 2) / 2 <= static_cast<int>(blockIdx.x)) ++i;
    const int j = blockIdx.x - i * (i + 1) / 2, k = pivot;
    if (i == k || j == k) return;
    __shared__ Tile left, right;
    if (k >= 0) {
      Tile::for_each([&](int r, int c) {
        const double number = i > k ? matrix.at(i, k, r, c) : matrix.at(k, i, r, c);
        (i > k ? left.at[r][c] : left.at[c][r]) = number;
        right.at[r][c] = column[(j * kTile + r) * kTile + c];
      });
      __syncthreads();
      TileProduct(left, right).for_each([&](int r, int c, double sum) { matrix.at(i, j, r, c) -= sum; });
    }
    if (i != k + 1 || j != k + 1) return;
    __syncthreads();
    Tile::for_each([&](int r, int c) { left.at[r][c] = matrix.at(i, i, r, c); });
    __syncthreads();
    invert<Real>(left, inverse);
  }
};

template <class Real>
class DenseInverse<Real, Cuda> {
 public:
  // By which a level of 512 nodes takes a sixth of what is in an H100's cache; GPUs for graphics are slow in
  // double precision.
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
        column_(cuda, stride() * kTile),
        pivot_(cuda, kTile * kTile),
        scale_(cuda, stride()) {}

  void make(Cuda& cuda, const BlockRowsView<Real>& matrix) {
    fill(cuda, matrix);
    const TiledMatrix tiled{matrix_.data(), stride()};
    const unsigned tiles = tiles_;
    for (int k = -1; k < tiles_; ++k) {
      if (k >= 0)
        launch(cuda, {"multigrid: dense column", 2 * column_.bytes()},
               SweptColumn{tiles, tiled, k, pivot_.data(), column_.data()});
      launch(cuda, {"multigrid: dense inverse", matrix_.bytes()},
             SweptRest<Real>{k < 0 ? 1 : tiles * (tiles + 1) / 2, tiled, k, column_.data(), pivot_.data()});
    }
    finish(cuda);
  }
  void apply(Cuda& cuda, const Vec3<Real>* b, Vec3<Real>* y, const int* stop) {
    for_each_row(cuda, {"multigrid: dense solve", matrix_.bytes() + 2 * rows_ * sizeof(Real)}, rows_,
                 row(b, y), stop);
  }
  DenseRow<Real> row(const Vec3<Real>* b, Vec3<Real>* y) const {
    return {matrix_.data(), stride(), rows_, b->data(), y->data()};
  }
  // Half of that for each pivot, since several solves may take the more iterations.
  double worth() const { return tiles_ / 4.0; }
  std::size_t bytes() const { return total_bytes(matrix_, column_, pivot_, scale_); }

  // The parts of make(); public because nvcc allows no device lambda in a private member function.
  // The lower triangle, scaled; ones on the diagonal, where nothing moves a node, too.
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
  // The inverse itself, both triangles.
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
  Buffer<double, Cuda> column_, pivot_;  // of the sweeps
  Buffer<double, Cuda> scale_;
};

}  // namespace hysteron
