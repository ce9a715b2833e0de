// Symmetric sweeps of dense matrices (Goodnight 1979: a tutorial on the sweep operator) keep the lower
// triangle alone.  Sweeping the pivots P of a front makes
//
//   P  C^T         -P^-1       .               C P^-1 carries right-hand sides from P's rows to the others,
//   C   R    ->    C P^-1   R - C P^-1 C^T     R - C P^-1 C^T is added to the parent front
//
// and, where no rows are left, minus the inverse: solves then are products, in which nothing waits.
#pragma once

#include <algorithm>
#include <limits>

#include "sim/device/device.h"
#include "sim/linear/dissection.h"

namespace hysteron {

// A front in whole tiles, scaled to a diagonal of ones; a pivot that cancels to less than rounding is
// replaced by the rounding.
struct SweptFront {
  double* number;          // stride x stride, row-major
  int tiles, pivot_tiles;  // rows of tiles, and those that are swept
  double* scratch;         // scratch_of(tiles) numbers

  HYST_HD int stride() const { return tiles * kTile; }
  // The scratch holds, for a pivot and the next one, its column and its inverse.
  static std::size_t scratch_of(int tiles) { return 2 * (tiles + 1) * kTile * kTile; }
  HYST_HD double* column_of(int pivot) const { return scratch + (pivot & 1) * stride() * kTile; }
  HYST_HD double* inverse_of(int pivot) const { return scratch + (2 * tiles + (pivot & 1)) * kTile * kTile; }
};

// Sweeps on the CPU, for tests, number by number.
template <class Real>
void sweep(const SweptFront& front) {
  constexpr double kMin = 2 * std::numeric_limits<Real>::epsilon();
  const int n = front.stride();
  const auto at = [&](int i, int j) -> double& {
    return front.number[static_cast<std::size_t>(std::max(i, j)) * n + std::min(i, j)];
  };
  double* column = front.column_of(0);
  for (int k = 0; k < front.pivot_tiles * kTile; ++k) {
    const double inverse = 1 / std::max(at(k, k), kMin);
    for (int i = 0; i < n; ++i) column[i] = at(i, k);
    for (int i = 0; i < n; ++i) {
      if (i == k || column[i] == 0) continue;
      const double factor = column[i] * inverse;
      double* row = front.number + static_cast<std::size_t>(i) * n;
      for (int j = 0; j <= i; ++j) row[j] -= factor * column[j];
    }
    for (int i = 0; i < n; ++i) at(i, k) = column[i] * inverse;
    at(k, k) = -inverse;
  }
}

}  // namespace hysteron

#ifdef __CUDACC__
#include "sim/linear/tile_sweeps.h"
#endif
