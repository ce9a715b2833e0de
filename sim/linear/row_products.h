// Multiplies rows of block matrices by vectors, with the lanes that a device gives a row (sim/device/rows.h).
//
// A warp's lane takes one number of each block, so that loads are contiguous:
//
//   lane = 9 b + 3 c + r      row r and column c of every third block, from the b-th on; five lanes idle
//
// and its sum belongs to component r of the product, r = lane % 3.  With nine lanes b is 0, and each reads
// its number of every block.
#pragma once

#include "sim/device/rows.h"
#include "sim/linear/coarse_level.h"
#include "sim/linear/gathered_forces.h"
#include "sim/linear/pair_product.h"
#include "sim/linear/preconditioner.h"

namespace hysteron {

// Returns component k of v[i].
template <class Real>
HYST_HD Real vector_component(const Vec3<Real>* v, int i, int k) {
  return v[i].data()[k];
}

// The next direction z + beta p, computed where it is read.
template <class Real>
struct NextDirection {
  const Vec3<Real>*z, *p;
  Real beta;
  HYST_HD Vec3<Real> operator[](int i) const { return z[i] + beta * p[i]; }
};
template <class Real>
HYST_HD Real vector_component(const NextDirection<Real>& v, int i, int k) {
  return v.z[i].data()[k] + v.beta * v.p[i].data()[k];
}

// The residual after a step, computed where it is read.
template <class Real>
struct NextResidual {
  Advance<Real> step;
  HYST_HD Real alpha() const { return static_cast<Real>(step.scalars->alpha); }
  HYST_HD Vec3<Real> operator[](int i) const { return step.r[i] - alpha() * step.q[i]; }
};
template <class Real>
HYST_HD Real vector_component(const NextResidual<Real>& v, int i, int k) {
  return v.step.r[i].data()[k] - v.alpha() * v.step.q[i].data()[k];
}

template <class Lanes, class Real>
class LaneSum {
  static constexpr int kBlocks = Lanes::kCount / 9;  // read at once

 public:
  HYST_HD explicit LaneSum(const Lanes& lanes)
      : lanes_(lanes), entry_(lanes.index() % 9), active_(lanes.index() < 9 * kBlocks) {}

  template <class Vector>
  HYST_HD void add(const Mat3<Real>& block, const Vector& v, int i) {  // adds block * v[i]
    if (lanes_.index() < 9) part_ += block.data()[entry_] * vector_component(v, i, column());
  }
  // Adds block[j] * v[col[j]] for j in [first, last).
  template <class Vector>
  HYST_HD void add(const Mat3<Real>* block, const int* col, int first, int last, const Vector& v) {
    if (!active_) return;
    for (int j = first + lanes_.index() / 9; j < last; j += kBlocks)
      part_ += block[j].data()[entry_] * vector_component(v, col[j], column());
  }
  // Adds factor[j] * v[index[j]] for j in [first, last).
  template <class Vector>
  HYST_HD void add(const Real* factor, const int* index, int first, int last, const Vector& v) {
    if (!active_) return;
    for (int j = first + lanes_.index() / 3; j < last; j += 3 * kBlocks)
      part_ += factor[j] * vector_component(v, index[j], lanes_.index() % 3);
  }
  // Adds sign times the forces on a vertex.
  HYST_HD void add(Real sign, const GatheredForces<Real>& forces, int vertex) {
    if (!active_ || !forces.start) return;
    for (int j = forces.start[vertex] + lanes_.index() / 3; j < forces.start[vertex + 1]; j += 3 * kBlocks)
      part_ += sign * forces.force[forces.item[j]].data()[lanes_.index() % 3];
  }

  // Adds the forces of a vertex's pairs under v.
  template <class Vector>
  HYST_HD void add(const PairProduct<Real>& pairs, int vertex, const Vector& v) {
    if (!active_ || !pairs.start) return;
    for (int j = pairs.start[vertex] + lanes_.index() / 9; j < pairs.start[vertex + 1]; j += kBlocks) {
      const int item = pairs.item[j];
      const PairStiffness<Real>& s = pairs.pair[item / 4];
      Real apart = 0;
      for (int k = 0; k < 4; ++k) apart += s.weight[k] * vector_component(v, s.v[k], column());
      part_ += s.weight[item % 4] * (s.block.data()[entry_] * apart);
    }
  }

  // Returns component r of the sum over the lanes, in lane r.
  HYST_HD Real component() const {
    Real sum = part_;
    if constexpr (kBlocks == 3) sum = part_ + lanes_.further(part_, 9) + lanes_.further(part_, 18);
    return sum + lanes_.further(sum, 3) + lanes_.further(sum, 6);
  }
  // Returns the sum over the lanes, in each of them.
  HYST_HD Vec3<Real> total() const {
    const Real sum = component();
    return {lanes_.lane_value(sum, 0), lanes_.lane_value(sum, 1), lanes_.lane_value(sum, 2)};
  }

 private:
  HYST_HD int column() const { return entry_ / 3; }
  Lanes lanes_;
  int entry_;
  bool active_;
  Real part_ = 0;
};

// Multiplies a block, one number per lane, by a vector of which lane r has component r, as it then has of the
// product.
template <class Lanes, class Real>
class LaneBlock {
 public:
  HYST_HD LaneBlock(const Lanes& lanes, const Mat3<Real>& block)
      : lanes_(lanes), entry_(lanes.index() < 9 ? block.data()[lanes.index()] : Real(0)) {}
  HYST_HD Real times(Real component) const {
    const Real part = entry_ * lanes_.lane_value(component, lanes_.index() / 3 % 3);
    return part + lanes_.further(part, 3) + lanes_.further(part, 6);
  }

 private:
  Lanes lanes_;
  Real entry_;
};

// Rows up to this number get a warp each; an H100 runs 8,448 warps at once, half of them in one launch.
inline constexpr int kMaxRowsByWarps = 4096;

// for_each_row() for a body that takes any lanes: on a GPU nine threads share each of many rows.
template <class Device, class Body>
void for_each_block_row(Device& device, const Kernel& kernel, int rows, const Body& body,
                        const int* stop = nullptr) {
  if constexpr (Device::kGpu) {
    if (rows > kMaxRowsByWarps) return for_each_row<NineLanes>(device, kernel, rows, body, stop);
  }
  for_each_row(device, kernel, rows, body, stop);
}
template <int K, class Device, class Body, class Finish>
void for_each_block_row_sum(Device& device, const Kernel& kernel, int rows, const Body& body,
                            const Finish& finish, [[maybe_unused]] int blocks_each = kRowSumBlocksEach) {
  if constexpr (Device::kGpu) {
    if (rows > kMaxRowsByWarps)
      return for_each_row_sum<K, NineLanes>(device, kernel, rows, body, finish, blocks_each);
  }
  for_each_row_sum<K>(device, kernel, rows, body, finish);
}
#ifdef __CUDACC__
// These use Team::for_each_row() and row_sum() (sim/device/grid_team.h) likewise.
template <class Team, class Body>
__device__ void for_each_block_row(Team& team, int rows, const Body& body) {
  if (rows > kMaxRowsByWarps) return team.template for_each_row<NineLanes>(rows, body);
  team.for_each_row(rows, body);
}
template <class Team, class Body>
__device__ double block_row_sum(Team& team, int rows, const Body& body) {
  if (rows > kMaxRowsByWarps) return team.template row_sum<NineLanes>(rows, body);
  return team.template row_sum<Warp>(rows, body);
}
#endif

template <class Lanes, class Real>
HYST_HD LaneSum<Lanes, Real> lane_sum_of_row(const Lanes& lanes, const BlockRowsView<Real>& matrix, int i,
                                             const Vec3<Real>* v) {
  LaneSum<Lanes, Real> sum(lanes);
  sum.add(matrix.diagonal[i], v, i);
  sum.add(matrix.off_diagonal, matrix.col, matrix.row_ptr[i], matrix.row_ptr[i + 1], v);
  return sum;
}

template <class Lanes, class Real>
HYST_HD Vec3<Real> row_times(const Lanes& lanes, const BlockRowsView<Real>& matrix, int i,
                             const Vec3<Real>* v) {
  if constexpr (Lanes::kCount == 1)
    return matrix.times(i, v);
  else
    return lane_sum_of_row(lanes, matrix, i, v).total();
}

// Multiplies a system's matrix, softening and elements by v.  A loop over rows without pairs takes fewer
// registers, so that more of its blocks run at once.
template <class Real, bool kHasPairs = true>
struct SystemProduct {
  BlockRowsView<Real> matrix;
  ScalarRowsView<Real> softening;  // null: none
  GatheredForces<Real> bending;    // -K v; null: none
  PairProduct<Real> pairs;         // null: none

  template <class Lanes, class Vector>
  HYST_HD Vec3<Real> at(const Lanes& lanes, int i, const Vector& v) const {
    if constexpr (Lanes::kCount == 1) {
      Vec3<Real> sum = softening.off_diagonal ? matrix.times(i, v, softening) : matrix.times(i, v);
      if (bending.start) sum -= bending.at(i);
      if constexpr (kHasPairs)
        if (pairs.start) sum += pairs.at(i, v);
      return sum;
    } else {
      LaneSum<Lanes, Real> sum(lanes);
      const int first = matrix.row_ptr[i], last = matrix.row_ptr[i + 1];
      sum.add(matrix.diagonal[i], v, i);
      sum.add(matrix.off_diagonal, matrix.col, first, last, v);
      if (softening.off_diagonal) sum.add(softening.off_diagonal, matrix.col, first, last, v);
      sum.add(Real(-1), bending, i);
      if constexpr (kHasPairs) sum.add(pairs, i, v);
      const Vec3<Real> total = sum.total();
      if (!softening.off_diagonal) return total;
      return total + softening.diagonal[i] * v[i];
    }
  }
};

}  // namespace hysteron
