// Sweeps on a GPU (front_sweeps.h), a tile of rows at a time.  With pivot tile P, its column C and every
// other tile A_ij:
//
//   A_ij <- A_ij - C_i P^-1 C_j^T     C_i <- C_i P^-1     P <- -P^-1
//
// Each pivot takes two launches, whatever the number of fronts.  Included by front_sweeps.h, under nvcc only.
#pragma once

#include <algorithm>
#include <limits>

#include "sim/device/rows.h"

namespace hysteron {

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

// The front that a block works on, and the block's number among those of the front.
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
// Several, in the GPU's memory; blocks beyond those of a smaller front have nothing to do.
struct ManyFronts {
  const SweptFront* front;
  int fronts;
  int count() const { return fronts; }
  __device__ FrontOfBlock of_block(int blocks_each) const {
    return {front[blockIdx.x / blocks_each], static_cast<int>(blockIdx.x) % blocks_each};
  }
};

// C of a pivot is kept beside the matrix, which gets C P^-1; the pivot's inverse is known.
template <class Fronts>
struct SweptColumn {
  unsigned blocks;
  int blocks_each;  // the front's rows of tiles, at least
  Fronts fronts;
  int pivot;

  __device__ void operator()() const {
    const FrontOfBlock mine = fronts.of_block(blocks_each);
    const SweptFront& front = mine.front;
    const int i = mine.block, k = pivot;
    if (k >= front.pivot_tiles || i >= front.tiles) return;
    const TiledMatrix matrix{front.number, front.stride()};
    const double* inverse = front.inverse;
    double* column = front.column;
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
template <class Real, class Fronts>
struct SweptRest {
  unsigned blocks;
  int blocks_each;  // tiles of the front's lower triangle, at least
  Fronts fronts;
  int pivot;

  __device__ void operator()() const {
    const FrontOfBlock mine = fronts.of_block(blocks_each);
    const SweptFront& front = mine.front;
    const int block = mine.block;
    int i = static_cast<int>((sqrtf(8.0f * block + 1) - 1) / 2);
    while (i * (i + 1) / 2 > block) --i;
    while ((i + 1) * (i + 2) / 2 <= block) ++i;
    const int j = block - i * (i + 1) / 2, k = pivot;
    if (k >= front.pivot_tiles || i >= front.tiles || i == k || j == k) return;
    const TiledMatrix matrix{front.number, front.stride()};
    const double* column = front.column;
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
    if (i != k + 1 || j != k + 1 || i >= front.pivot_tiles) return;
    __syncthreads();
    Tile::for_each([&](int r, int c) { left.at[r][c] = matrix.at(i, i, r, c); });
    __syncthreads();
    invert<Real>(left, front.inverse);
  }
};

// Every front's pivots, of which one has `pivots` tiles at most and `tiles` rows of tiles.
template <class Real, class Fronts>
void sweep_fronts(Cuda& cuda, const Fronts& fronts, int tiles, int pivots, const Kernel& column,
                  const Kernel& rest) {
  const int triangle = tiles * (tiles + 1) / 2, count = fronts.count();
  const auto blocks = [&](int each) { return static_cast<unsigned>(each) * count; };
  launch(cuda, rest, SweptRest<Real, Fronts>{blocks(1), 1, fronts, -1});
  for (int k = 0; k < pivots; ++k) {
    launch(cuda, column, SweptColumn<Fronts>{blocks(tiles), tiles, fronts, k});
    launch(cuda, rest, SweptRest<Real, Fronts>{blocks(triangle), triangle, fronts, k});
  }
}

}  // namespace hysteron
