// The parts of a multigrid cycle on coarse levels, node by node.
#pragma once

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

}  // namespace hysteron
