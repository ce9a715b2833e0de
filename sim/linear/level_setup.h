// What multigrid makes of a new matrix, element by element: coarse matrices, power iteration, dense inverse.
#pragma once

#include <Eigen/LU>
#include <limits>

#include "sim/linear/cycle.h"

namespace hysteron {

inline constexpr int kPowerSteps = 8;

// Inverse of a symmetric positive semidefinite block; a direction without stiffness of its own, beyond
// rounding, gets that of the rounding.  Zero for a zero block, which belongs to a node that nothing moves.
template <class Real>
HYST_HD inline Mat3<Real> safe_inverse(const Mat3<Real>& block) {
  const Real trace = block(0, 0) + block(1, 1) + block(2, 2);
  if (!(trace > 0)) return Mat3<Real>::Zero();
  Mat3<Real> scaled = block / trace;
  for (int k = 0; k < 3; ++k) scaled(k, k) += 2 * std::numeric_limits<Real>::epsilon();
  const Mat3<Real> inverse = scaled.inverse();  // by itself: within an expression Eigen inverts on the host
  return inverse / trace;
}

// L v with L L^T = block, lower triangular; zero rows stay zero.
template <class Real>
HYST_HD inline Vec3<Real> times_cholesky(const Mat3<Real>& block, const Vec3<Real>& v) {
  using std::sqrt;
  Mat3<Real> l = Mat3<Real>::Zero();
  for (int k = 0; k < 3; ++k)
    for (int i = k; i < 3; ++i) {
      Real rest = block(i, k);
      for (int m = 0; m < k; ++m) rest -= l(i, m) * l(k, m);
      if (i == k)
        l(k, k) = rest > 0 ? sqrt(rest) : Real(0);
      else
        l(i, k) = l(k, k) > 0 ? rest / l(k, k) : Real(0);
    }
  return l * v;
}

// Between -1 and 1.
template <class Real>
HYST_HD inline Vec3<Real> rough_vector(int i) {
  Vec3<Real> v;
  for (int k = 0; k < 3; ++k) {
    const unsigned hash = (3u * static_cast<unsigned>(i) + static_cast<unsigned>(k) + 1u) * 2654435761u;
    v[k] = static_cast<Real>(hash >> 16) / Real(32768) - 1;
  }
  return v;
}

// A block of the coarse matrix of a finer one, with its mirror image or, on the diagonal, its inverse.  Every
// block gathers its own sum, in the order of the finer nodes; in double, for its terms cancel.
template <class Real>
struct Coarsening {
  BlockRowsView<Real> finer;
  const char* held;  // finer nodes that do not move; null: none
  CoarseLevelView<Real> coarse;
  const UpperBlock* upper;
  const Real *plate_off_diagonal, *plate_diagonal;
  Real rigidity;  // of the plate that is added

  template <class Lanes>
  HYST_HD void operator()(int u, const Lanes& lanes) const {
    const UpperBlock at = upper[u];
    const Eigen::Matrix3d sum = lanes.sum_of(gathered(at, lanes));
    if (!lanes.leads()) return;
    if (at.slot >= 0) {
      put(at.slot, sum);
      put(at.mirror, sum.transpose());
      return;
    }
    Mat3<Real> diagonal = (0.5 * (sum + sum.transpose())).template cast<Real>();
    for (int k = 0; k < 3; ++k) diagonal(k, k) += rigidity * plate_diagonal[at.row];
    coarse.matrix.diagonal[at.row] = diagonal;
    coarse.inverse[at.row] = safe_inverse<Real>(diagonal);
  }

  // A lane's part: of a warp, eight lanes take a finer row together.
  template <class Lanes>
  HYST_HD Eigen::Matrix3d gathered(const UpperBlock& at, const Lanes& lanes) const {
    constexpr int kWide = Lanes::kCount == 1 ? 1 : 8;
    const int lane = lanes.index() % kWide;
    Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
    for (int k = coarse.start[at.row] + lanes.index() / kWide; k < coarse.start[at.row + 1];
         k += Lanes::kCount / kWide) {
      const int i = coarse.item[k];
      if (held && held[i]) continue;
      const Real own = coarse.weight[k];
      if (lane == 0) {
        const Real diagonal = own * coarse.finer[i].weight_of(at.column);
        if (diagonal != 0) sum += (diagonal * finer.diagonal[i]).template cast<double>();
      }
      for (int j = finer.row_ptr[i] + lane; j < finer.row_ptr[i + 1]; j += kWide) {
        const int other = finer.col[j];
        const Real weight = own * coarse.finer[other].weight_of(at.column);
        if (weight == 0 || (held && held[other])) continue;
        sum += (weight * finer.off_diagonal[j]).template cast<double>();
      }
    }
    return sum;
  }

  HYST_HD void put(int slot, const Eigen::Matrix3d& sum) const {
    Mat3<Real> block = sum.template cast<Real>();
    for (int k = 0; k < 3; ++k) block(k, k) += rigidity * plate_off_diagonal[slot];
    coarse.matrix.off_diagonal[slot] = block;
  }
};

// A fixed rough vector in which stiff and soft directions have equal energies: x.
template <class Real>
struct RoughStart {
  CoarseLevelView<Real> level;
  HYST_HD void operator()(int i) const {
    level.x[i] = times_cholesky<Real>(level.inverse[i], rough_vector<Real>(i));
  }
};

// One step of power iteration on D^-1 A.
template <class Real>
struct PowerStep {
  CoarseLevelView<Real> level;
  const Vec3<Real>* from;
  Vec3<Real>* to;

  template <class Lanes>
  HYST_HD void operator()(int i, const Lanes& lanes) const {
    const Mat3<Real> inverse = level.inverse[i];
    const Vec3<Real> product = row_times(lanes, level.matrix, i, from);
    if (lanes.leads()) to[i] = inverse * product;
  }
};

// Block Gauss-Jordan without exchange of rows.  A pivot is inverted by whoever finishes it: for each of the
// others to do so would take most of the time.
struct DenseInversion {
  Eigen::Matrix3d *a, *next;  // blocks row by row, before a pivot and after it
  Eigen::Matrix3d* pivot;     // the inverse of each
  int n;

  // A matrix's blocks, zeros included.
  template <class Real>
  HYST_HD void fill(const BlockRowsView<Real>& matrix, int e) const {
    const int i = e / n, column = e % n;
    Eigen::Matrix3d block = Eigen::Matrix3d::Zero();
    if (i == column) block = matrix.diagonal[i].template cast<double>();
    for (int j = matrix.row_ptr[i]; j < matrix.row_ptr[i + 1]; ++j)
      if (matrix.col[j] == column) block = matrix.off_diagonal[j].template cast<double>();
    put(a, e, block, 0);
  }
  HYST_HD void eliminate(int k, int e) const {
    const int i = e / n, j = e % n;
    Eigen::Matrix3d block;
    if (i == k)
      block = j == k ? pivot[k] : Eigen::Matrix3d(pivot[k] * a[e]);
    else if (j == k)
      block = -a[e] * pivot[k];
    else
      block = a[e] - a[i * n + k] * (pivot[k] * a[k * n + j]);
    put(next, e, block, k + 1);
  }

 private:
  HYST_HD void put(Eigen::Matrix3d* to, int e, const Eigen::Matrix3d& block, int next_pivot) const {
    to[e] = block;
    if (e == next_pivot * n + next_pivot) pivot[next_pivot] = safe_inverse<double>(block);
  }
};

template <class Real>
struct DenseFill {
  DenseInversion inversion;
  BlockRowsView<Real> matrix;
  HYST_HD void operator()(int e) const { inversion.fill(matrix, e); }
};

struct DensePivot {
  DenseInversion inversion;
  int k;
  HYST_HD void operator()(int e) const { inversion.eliminate(k, e); }
};

// A team for each small level: power iteration, whose last vector is in y, or the dense inverse.
template <class Real>
struct SmallSetup {
  SmallLevels<Real> levels;
  // The inverse of n nodes' matrix ends in the first if n is even, in the second if it is odd.
  Eigen::Matrix3d *dense, *next, *pivots;

  template <class Team>
  HYST_HD void operator()(int t, const Team& team) const {
    const CoarseLevelView<Real>& level = levels.level[t];
    if (levels.dense_inverse && t == levels.count - 1)
      invert(level.matrix, team);
    else
      iterate(level, team);
  }

  template <class Team>
  HYST_HD static void iterate(const CoarseLevelView<Real>& level, const Team& team) {
    team.for_each(level.nodes, RoughStart<Real>{level});
    for (int step = 1; step < kPowerSteps; ++step)
      team.for_each_row(level.nodes,
                        PowerStep<Real>{level, step % 2 ? level.x : level.y, step % 2 ? level.y : level.x});
  }

  template <class Team>
  HYST_HD void invert(const BlockRowsView<Real>& matrix, const Team& team) const {
    const int n = matrix.rows;
    DenseInversion inversion{dense, next, pivots, n};
    team.for_each(n * n, DenseFill<Real>{inversion, matrix});
    for (int k = 0; k < n; ++k) {
      team.for_each(n * n, DensePivot{inversion, k});
      Eigen::Matrix3d* done = inversion.next;
      inversion.next = inversion.a;
      inversion.a = done;
    }
  }
};
static_assert(kPowerSteps % 2 == 0);  // SmallSetup's last vector is in y

}  // namespace hysteron
