// Sweeps fronts on a GPU (front_sweeps.h), a tile of rows at a time.  With pivot tile P, its column C and
// every other tile A_ij:
//
//   A_ij <- A_ij - C_i P^-1 C_j^T     C_i <- C_i P^-1     P <- -P^-1
//
// Each pivot takes a launch, whatever the number of fronts.  Included by front_sweeps.h, under nvcc only.
#pragma once

#include <algorithm>
#include <limits>

#include "sim/device/rows.h"

namespace hysteron {

// A tile in shared memory; the padding keeps a column's numbers in different banks.
struct Tile {
  double at[kTile][kTile + 1];

  template <class Visit>
  static __device__ void for_each(const Visit& visit) {
    for (int e = threadIdx.x; e < kTile * kTile; e += kThreadsPerBlock) visit(e / kTile, e % kTile);
  }
};

// The lower triangle of a symmetric matrix in whole tiles.
struct TiledMatrix {
  double* number;  // row-major
  int stride;      // length of a row

  // Returns a number of tile (i, j), which is the transpose of (j, i).
  __device__ double& at(int i, int j, int row, int column) const {
    return i >= j ? entry(i, j, row, column) : entry(j, i, column, row);
  }

 private:
  __device__ double& entry(int i, int j, int row, int column) const {
    return number[static_cast<std::size_t>(i * kTile + row) * stride + j * kTile + column];
  }
};

// A thread's part of a b^T: two rows, four columns.
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

// Inverts a positive definite tile, given by its lower triangle, by a block of threads: four share a row.
template <class Real>
__device__ void invert(const Tile& tile, double* inverse) {
  constexpr int kColumnsPerThread = kTile / 4;
  // A direction whose stiffness is mere rounding gets the stiffness of the rounding; the diagonal was 1.
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

// The front that a block works on, and the block's number within the front.
struct FrontOfBlock {
  SweptFront front;
  int block;
};
// One front, which travels with the launch.
struct OneFront {
  SweptFront front;
  int count() const { return 1; }
  __device__ FrontOfBlock of_block(int /*blocks_each*/) const {
    return {front, static_cast<int>(blockIdx.x)};
  }
};
// Several fronts in the GPU's memory; blocks beyond those of a smaller front have nothing to do.
struct ManyFronts {
  const SweptFront* front;
  int fronts;
  int count() const { return fronts; }
  __device__ FrontOfBlock of_block(int blocks_each) const {
    return {front[blockIdx.x / blocks_each], static_cast<int>(blockIdx.x) % blocks_each};
  }
};

// Sweeps a pivot k of every front.  The block that finishes the next pivot's tile and column inverts the tile
// and keeps a copy of the column beside the matrix, in the launch before: no block reads what another one
// writes.  Each block computes C_i P^-1 itself, which takes less than a launch.
template <class Real, class Fronts>
struct SweptPivot {
  unsigned blocks;
  int blocks_each;  // the most tiles of a front's lower triangle
  Fronts fronts;
  int pivot;  // -1: only prepares the first pivot

  __device__ void operator()() const {
    const FrontOfBlock mine = fronts.of_block(blocks_each);
    const SweptFront& front = mine.front;
    const int block = mine.block, k = pivot;
    int i = static_cast<int>((sqrtf(8.0f * block + 1) - 1) / 2);
    while (i * (i + 1) / 2 > block) --i;
    while ((i + 1) * (i + 2) / 2 <= block) ++i;
    const int j = block - i * (i + 1) / 2;
    const bool is_next = k + 1 < front.pivot_tiles && (i == k + 1 || j == k + 1);
    if (k >= front.pivot_tiles || i >= front.tiles || (k < 0 && !is_next)) return;
    __shared__ Tile result;
    find(front, i, j, result);
    const TiledMatrix matrix{front.number, front.stride()};
    if (k >= 0) Tile::for_each([&](int r, int c) { matrix.at(i, j, r, c) = result.at[r][c]; });
    if (!is_next) return;
    if (i == j) return invert<Real>(result, front.inverse_of(k + 1));
    double* column = front.column_of(k + 1) + (i == k + 1 ? j : i) * kTile * kTile;
    Tile::for_each(
        [&](int r, int c) { column[r * kTile + c] = i == k + 1 ? result.at[c][r] : result.at[r][c]; });
  }

 private:
  // Computes tile (i, j) after the pivot.
  __device__ void find(const SweptFront& front, int i, int j, Tile& result) const {
    __shared__ Tile left, right;
    const TiledMatrix matrix{front.number, front.stride()};
    const int k = pivot;
    const double *inverse = front.inverse_of(k), *column = front.column_of(k);
    if (k < 0 || (i == k && j == k)) {
      Tile::for_each(
          [&](int r, int c) { result.at[r][c] = k < 0 ? matrix.at(i, j, r, c) : -inverse[r * kTile + c]; });
      __syncthreads();
      return;
    }
    const int m = i == k ? j : i;
    Tile::for_each([&](int r, int c) {
      left.at[r][c] = column[(m * kTile + r) * kTile + c];
      right.at[r][c] = inverse[r * kTile + c];
    });
    __syncthreads();
    const TileProduct scaled(left, right);  // C_m P^-1
    __syncthreads();
    if (i == k || j == k) {
      scaled.for_each([&](int r, int c, double sum) { (i == k ? result.at[c][r] : result.at[r][c]) = sum; });
    } else {
      scaled.for_each([&](int r, int c, double sum) { left.at[r][c] = sum; });
      Tile::for_each([&](int r, int c) { right.at[r][c] = column[(j * kTile + r) * kTile + c]; });
      __syncthreads();
      TileProduct(left, right).for_each([&](int r, int c, double sum) {
        result.at[r][c] = matrix.at(i, j, r, c) - sum;
      });
    }
    __syncthreads();
  }
};

// Sweeps every front's pivots; a front has at most `pivots` tiles of pivots and `tiles` rows of tiles.
template <class Real, class Fronts>
void sweep_fronts(Cuda& cuda, const Fronts& fronts, int tiles, int pivots, const Kernel& kernel) {
  const int each = tiles * (tiles + 1) / 2;
  const unsigned blocks = static_cast<unsigned>(each) * fronts.count();
  for (int k = -1; k < pivots; ++k) launch(cuda, kernel, SweptPivot<Real, Fronts>{blocks, each, fronts, k});
}

}  // namespace hysteron
