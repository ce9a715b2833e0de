// The implicit solve's matrix: 3x3 blocks, one row per vertex, the diagonal kept apart.
#pragma once

#include <algorithm>
#include <vector>

#include "sim/device/device.h"
#include "sim/mesh/cloth_mesh.h"

namespace hysteron {

// A number for every block of a BlockRowsView: that multiple of the identity.
template <class Real>
struct ScalarRowsView {
  Real* off = nullptr;
  Real* diagonal = nullptr;
};

template <class Real>
struct BlockRowsView {
  int rows;
  const int* start;  // off-diagonal blocks of row i: start[i] ... start[i+1]-1
  const int* column;
  Mat3<Real>* off;  // off-diagonal blocks
  Mat3<Real>* diagonal;

  HYST_HD Vec3<Real> times(int i, const Vec3<Real>* v) const {
    Vec3<Real> sum = diagonal[i] * v[i];
    for (int j = start[i]; j < start[i + 1]; ++j) sum += off[j] * v[column[j]];
    return sum;
  }
  // The same with `added` on top.
  HYST_HD Vec3<Real> times(int i, const Vec3<Real>* v, const ScalarRowsView<Real>& added) const {
    Vec3<Real> sum = diagonal[i] * v[i] + added.diagonal[i] * v[i];
    for (int j = start[i]; j < start[i + 1]; ++j) {
      const Vec3<Real> other = v[column[j]];
      sum += off[j] * other + added.off[j] * other;
    }
    return sum;
  }
};

template <class Real, class Device>
class BlockRows {
 public:
  // Pattern: one off-diagonal block for each pair of vertices that share a triangle.
  BlockRows(Device& device, const ClothMesh& mesh) {
    std::vector<std::vector<int>> neighbours(mesh.vertices());
    for (const auto& f : mesh.face)
      for (int k = 0; k < 3; ++k)
        for (int l = 0; l < 3; ++l)
          if (k != l) neighbours[f[k]].push_back(f[l]);
    start_host.push_back(0);
    for (auto& row : neighbours) {
      std::sort(row.begin(), row.end());
      row.erase(std::unique(row.begin(), row.end()), row.end());
      column_host.insert(column_host.end(), row.begin(), row.end());
      start_host.push_back(static_cast<int>(column_host.size()));
    }
    start_ = Buffer<int, Device>(device, start_host);
    column_ = Buffer<int, Device>(device, column_host);
    off_ = Buffer<Mat3<Real>, Device>(device, column_host.size());
    diagonal_ = Buffer<Mat3<Real>, Device>(device, mesh.vertices());
  }

  BlockRowsView<Real> view() {
    return {static_cast<int>(diagonal_.size()), start_.data(), column_.data(), off_.data(), diagonal_.data()};
  }
  // Position of block (row, column) among the off-diagonal blocks.
  int slot(int row, int column) const {
    const auto first = column_host.begin() + start_host[row],
               last = column_host.begin() + start_host[row + 1];
    return static_cast<int>(std::lower_bound(first, last, column) - column_host.begin());
  }
  const std::vector<int>& start() const { return start_host; }
  const std::vector<int>& column() const { return column_host; }
  std::vector<Mat3<Real>> off() const { return off_.download(); }
  std::vector<Mat3<Real>> diagonal() const { return diagonal_.download(); }
  std::size_t bytes() const { return start_.bytes() + column_.bytes() + off_.bytes() + diagonal_.bytes(); }

 private:
  std::vector<int> start_host, column_host;
  Buffer<int, Device> start_, column_;
  Buffer<Mat3<Real>, Device> off_, diagonal_;
};

}  // namespace hysteron
