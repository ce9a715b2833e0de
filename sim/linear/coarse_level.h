// Holds one coarse level of the multigrid preconditioner on one device: interpolation, matrix and vectors.
#pragma once

#include "sim/linear/block_rows.h"
#include "sim/linear/compressed_rows.h"
#include "sim/linear/rest_hierarchy.h"

namespace hysteron {

template <class Real>
struct DeviceInterpolation {
  int node[3];
  Real weight[3];

  // Returns the value interpolated from the coarse nodes' values.
  HYST_HD Vec3<Real> of(const Vec3<Real>* coarse) const {
    return weight[0] * coarse[node[0]] + weight[1] * coarse[node[1]] + weight[2] * coarse[node[2]];
  }
  HYST_HD Real interpolation_weight(int coarse) const {
    Real sum = 0;
    for (int k = 0; k < 3; ++k) sum += node[k] == coarse ? weight[k] : Real(0);
    return sum;
  }
};

template <class Real>
struct CoarseLevelView {
  int nodes;
  const DeviceInterpolation<Real>* finer;  // one per finer node
  // The transpose: the finer nodes that are interpolated from each coarse node.
  const int* start;    // nodes + 1 row starts
  const int* item;     // finer nodes
  const Real* weight;  // one per item
  BlockRowsView<Real> matrix;
  Mat3<Real>* inverse;         // `nodes` inverted diagonal blocks
  double* inverse_eigenvalue;  // 1 over the largest eigenvalue of inverse * matrix
  // Vectors of `nodes`: right-hand side; sweeps go from x to y and back; the result is in y.
  Vec3<Real>*b, *x, *y;

  template <class Vector>
  HYST_HD Vec3<Real> restricted(int i, const Vector& fine) const {
    Vec3<Real> sum = Vec3<Real>::Zero();
    for (int j = start[i]; j < start[i + 1]; ++j) sum += weight[j] * fine[item[j]];
    return sum;
  }
};

template <class Real, class Device>
struct CoarseLevel {
  int nodes;
  Buffer<DeviceInterpolation<Real>, Device> finer;
  Buffer<int, Device> gather_start, gather_item;
  Buffer<Real, Device> gather_weight;
  Buffer<int, Device> row_ptr, col;
  Buffer<UpperBlock, Device> upper;
  Buffer<Real, Device> plate_off_diagonal, plate_diagonal;
  Buffer<Mat3<Real>, Device> off_diagonal, diagonal, inverse;
  Buffer<double, Device> inverse_eigenvalue;
  Buffer<Vec3<Real>, Device> b, x, y;

  CoarseLevel(Device& device, const RestLevel& level);
  CoarseLevelView<Real> view();
  std::size_t matrix_bytes() const { return total_bytes(row_ptr, col, off_diagonal, diagonal); }
  std::size_t gather_bytes() const { return total_bytes(gather_start, gather_item, gather_weight); }
  std::size_t bytes() const;
};

}  // namespace hysteron
