// Sets up multigrid for a new matrix, element by element: coarse matrices and power iteration.
#pragma once

#include "sim/linear/dense_inverse.h"

namespace hysteron {

inline constexpr int kPowerSteps = 8;

// Returns L v with L L^T = block, L lower triangular; zero rows stay zero.
template <class Real>
HYST_HD inline Vec3<Real> times_cholesky(const Mat3<Real>& block, const Vec3<Real>& v) {
  using std::sqrt;
  Mat3<Real> l = Mat3<Real>::Zero();
  for (int k = 0; k < 3; ++k)
    for (int i = k; i < 3; ++i) {
      Real remainder = block(i, k);
      for (int m = 0; m < k; ++m) remainder -= l(i, m) * l(k, m);
      if (i == k)
        l(k, k) = remainder > 0 ? sqrt(remainder) : Real(0);
      else
        l(i, k) = l(k, k) > 0 ? remainder / l(k, k) : Real(0);
    }
  return l * v;
}

// Returns a vector of rough numbers between -1 and 1.
template <class Real>
HYST_HD inline Vec3<Real> rough_vector(int i) {
  Vec3<Real> v;
  for (int k = 0; k < 3; ++k) {
    const unsigned hash = (3u * static_cast<unsigned>(i) + static_cast<unsigned>(k) + 1u) * 2654435761u;
    v[k] = static_cast<Real>(hash >> 16) / Real(32768) - 1;
  }
  return v;
}

// Computes a block of the coarse matrix from a finer one, with its mirror image or, on the diagonal, its
// inverse.  Every block gathers its own sum, in the order of the finer nodes; it does so in double, for its
// terms cancel.
template <class Real>
struct Coarsening {
  BlockRowsView<Real> finer;
  const char* held;  // flags of finer nodes that do not move; null: none
  CoarseLevelView<Real> coarse;
  const UpperBlock* upper;
  const Real *plate_off_diagonal, *plate_diagonal;
  Real rigidity;  // rigidity of the added plate

  template <class Lanes>
  HYST_HD void operator()(int u, const Lanes& lanes) const {
    const UpperBlock at = upper[u];
    const Eigen::Matrix3d sum = lanes.lane_sum(gathered(at, lanes));
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

  // Returns a lane's part: eight lanes of a warp share a finer row.
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
        const Real diagonal = own * coarse.finer[i].interpolation_weight(at.column);
        if (diagonal != 0) sum += (diagonal * finer.diagonal[i]).template cast<double>();
      }
      for (int j = finer.row_ptr[i] + lane; j < finer.row_ptr[i + 1]; j += kWide) {
        const int other = finer.col[j];
        const Real weight = own * coarse.finer[other].interpolation_weight(at.column);
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

// Sets x to a fixed rough vector in which stiff and soft directions have equal energies.
template <class Real>
struct RoughStart {
  CoarseLevelView<Real> level;
  HYST_HD void operator()(int i) const {
    level.x[i] = times_cholesky<Real>(level.inverse[i], rough_vector<Real>(i));
  }
};

// Takes one step of power iteration on D^-1 A.
template <class Real>
struct PowerStep {
  CoarseLevelView<Real> level;
  const Vec3<Real>* from;
  Vec3<Real>* to;

  template <class Lanes>
  HYST_HD void operator()(int i, const Lanes& lanes) const {
    if constexpr (Lanes::kCount == 1) {
      to[i] = level.inverse[i] * level.matrix.times(i, from);
    } else {
      const LaneBlock<Lanes, Real> inverse(lanes, level.inverse[i]);
      const Real product = inverse.times(lane_sum_of_row(lanes, level.matrix, i, from).component());
      if (lanes.index() < 3) to[i].data()[lanes.index()] = product;
    }
  }
};

static_assert(kPowerSteps % 2 == 0);  // the last vector is in y

// Takes its last step, y' A y and y' D y, whose quotient needs no normalisation before.
template <class Real>
struct RayleighTerms {
  CoarseLevelView<Real> level;

  template <class Lanes>
  HYST_HD void operator()(int i, const Lanes& lanes, Sums<2>& sums) const {
    const Vec3<Real> y = level.y[i], product = row_times(lanes, level.matrix, i, level.y);
    if (!lanes.leads()) return;
    sums.term[0] += static_cast<double>(y.dot(product));
    sums.term[1] += static_cast<double>(y.dot(level.matrix.diagonal[i] * y));
  }
};
HYST_HD inline double inverse_eigenvalue(const Sums<2>& rayleigh) {
  constexpr double kMargin = 1.1;  // power iteration underestimates by some percent
  return rayleigh.term[0] > 0 ? rayleigh.term[1] / (kMargin * rayleigh.term[0]) : 0;
}

}  // namespace hysteron
