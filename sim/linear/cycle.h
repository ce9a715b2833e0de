// The parts of a multigrid cycle on coarse levels, node by node, and the cycle of all small levels in one
// launch.
#pragma once

#include "sim/device/team.h"
#include "sim/linear/row_products.h"

namespace hysteron {

// Two sweeps of damped Jacobi whose dampings, over the largest eigenvalue, are those of the Chebyshev
// polynomial for the upper three quarters of the spectrum: 1/(5/8 -+ 3/8 cos(pi/4)).  Together they reduce
// that part to 0.22 at most and bear an eigenvalue found too small by a fifth.
inline constexpr double kFirstDamping = 1.1233, kSecondDamping = 2.7790;

// Right-hand side from the finer residual and, where the level is swept, the first sweep from zero: x.
template <class Real>
struct Restriction {
  CoarseLevelView<Real> level;
  const Vec3<Real>* finer;
  bool is_swept;

  template <class Lanes>
  HYST_HD void operator()(int i, const Lanes& lanes) const {
    const Vec3<Real> b = restricted(lanes, level, i, finer);
    if (!lanes.leads()) return;
    level.b[i] = b;
    if (is_swept)
      level.x[i] = static_cast<Real>(kFirstDamping * *level.inverse_eigenvalue) * (level.inverse[i] * b);
  }
};

// One sweep of damped Jacobi.
template <class Real>
struct JacobiSweep {
  CoarseLevelView<Real> level;
  double damping;
  const Vec3<Real>* from;
  Vec3<Real>* to;

  template <class Lanes>
  HYST_HD void operator()(int i, const Lanes& lanes) const {
    // What waits for nothing is read first.
    const Mat3<Real> inverse = level.inverse[i];
    const Real factor = static_cast<Real>(damping * *level.inverse_eigenvalue);
    const Vec3<Real> b = level.b[i], before = from[i];
    const Vec3<Real> residual = b - row_times(lanes, level.matrix, i, from);
    if (lanes.leads()) to[i] = before + factor * (inverse * residual);
  }
};

// What y leaves of b: x.
template <class Real>
struct LevelResidual {
  CoarseLevelView<Real> level;

  template <class Lanes>
  HYST_HD void operator()(int i, const Lanes& lanes) const {
    const Vec3<Real> residual = level.b[i] - row_times(lanes, level.matrix, i, level.y);
    if (lanes.leads()) level.x[i] = residual;
  }
};

template <class Real>
struct CoarseCorrection {
  CoarseLevelView<Real> level, coarser;
  HYST_HD void operator()(int i) const { level.y[i] += coarser.finer[i].of(coarser.y); }
};

// y = inverse b.
template <class Real>
struct DenseSolve {
  CoarseLevelView<Real> level;
  const Eigen::Matrix3d* inverse;

  template <class Lanes>
  HYST_HD void operator()(int i, const Lanes& lanes) const {
    const Eigen::Vector3d sum = dense_row_times(lanes, inverse, level.nodes, i, level.b);
    if (lanes.leads()) level.y[i] = sum.template cast<Real>();
  }
};

// The coarsest levels, finest of them first.
template <class Real>
struct SmallLevels {
  static constexpr int kMost = 8;
  int count = 0;
  CoarseLevelView<Real> level[kMost];
  const Eigen::Matrix3d* dense_inverse = nullptr;  // of the last one; null: it is swept like the others
};

// One V(2,2)-cycle on them from the next finer level's residual; the result is in the first one's y.
template <class Real>
struct SmallCycle {
  SmallLevels<Real> levels;
  const Vec3<Real>* residual;

  template <class Team>
  HYST_HD void operator()(int /*team*/, const Team& team) const {
    const bool dense = levels.dense_inverse;
    const int last = levels.count - 1;
    for (int l = 0; l <= last; ++l) {
      const CoarseLevelView<Real>& level = levels.level[l];
      const bool is_swept = l < last || !dense;
      team.for_each_row(level.nodes,
                        Restriction<Real>{level, l == 0 ? residual : levels.level[l - 1].x, is_swept});
      if (!is_swept) team.for_each_row(level.nodes, DenseSolve<Real>{level, levels.dense_inverse});
      if (is_swept)
        team.for_each_row(level.nodes, JacobiSweep<Real>{level, kSecondDamping, level.x, level.y});
      if (l < last) team.for_each_row(level.nodes, LevelResidual<Real>{level});
    }
    for (int l = dense ? last - 1 : last; l >= 0; --l) {
      const CoarseLevelView<Real>& level = levels.level[l];
      if (l < last) team.for_each(level.nodes, CoarseCorrection<Real>{level, levels.level[l + 1]});
      team.for_each_row(level.nodes, JacobiSweep<Real>{level, kFirstDamping, level.y, level.x});
      team.for_each_row(level.nodes, JacobiSweep<Real>{level, kSecondDamping, level.x, level.y});
    }
  }
};

}  // namespace hysteron
