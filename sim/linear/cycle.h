// Defines the parts of a multigrid cycle, node by node.
#pragma once

#include "sim/linear/preconditioner.h"
#include "sim/linear/row_products.h"

namespace hysteron {

// Two sweeps of damped Jacobi have dampings, over the largest eigenvalue, that are those of the Chebyshev
// polynomial for the upper three quarters of the spectrum: 1/(5/8 -+ 3/8 cos(pi/4)).  Together they reduce
// that part to 0.22 at most and bear an eigenvalue found too small by a fifth.
inline constexpr double kFirstDamping = 1.1233, kSecondDamping = 2.7790;

// Restricts the finer residual to the right-hand side b and, where the level is swept, makes the first sweep
// from zero: x.
template <class Real, class Vector = const Vec3<Real>*>
struct Restriction {
  CoarseLevelView<Real> level;
  Vector finer;
  bool is_swept;

  template <class Lanes>
  HYST_HD void operator()(int i, const Lanes& lanes) const {
    const Real factor = is_swept ? static_cast<Real>(kFirstDamping * *level.inverse_eigenvalue) : Real(0);
    if constexpr (Lanes::kCount == 1) {
      level.b[i] = level.restricted(i, finer);
      if (is_swept) level.x[i] = factor * (level.inverse[i] * level.b[i]);
    } else {
      const LaneBlock<Lanes, Real> inverse(lanes, level.inverse[i]);
      LaneSum<Lanes, Real> sum(lanes);
      sum.add(level.weight, level.item, level.start[i], level.start[i + 1], finer);
      const int r = lanes.index() % 3;
      const Real b = sum.component(), change = inverse.times(b);
      if (lanes.index() >= 3) return;
      level.b[i].data()[r] = b;
      if (is_swept) level.x[i].data()[r] = factor * change;
    }
  }
};

// Makes one sweep of damped Jacobi.
template <class Real>
struct JacobiSweep {
  CoarseLevelView<Real> level;
  double damping;
  const Vec3<Real>* from;
  Vec3<Real>* to;

  template <class Lanes>
  HYST_HD void operator()(int i, const Lanes& lanes) const {
    const Real factor = static_cast<Real>(damping * *level.inverse_eigenvalue);
    if constexpr (Lanes::kCount == 1) {
      const Vec3<Real> residual = level.b[i] - level.matrix.times(i, from);
      to[i] = from[i] + factor * (level.inverse[i] * residual);
    } else {  // data that depends on nothing is read first
      const LaneBlock<Lanes, Real> inverse(lanes, level.inverse[i]);
      const int r = lanes.index() % 3;
      const Real b = vector_component(level.b, i, r), before = vector_component(from, i, r);
      const Real change = inverse.times(b - lane_sum_of_row(lanes, level.matrix, i, from).component());
      if (lanes.index() < 3) to[i].data()[r] = before + factor * change;
    }
  }
};

// Sets x to the residual b - A y.
template <class Real>
struct LevelResidual {
  CoarseLevelView<Real> level;

  template <class Lanes>
  HYST_HD void operator()(int i, const Lanes& lanes) const {
    if constexpr (Lanes::kCount == 1) {
      level.x[i] = level.b[i] - level.matrix.times(i, level.y);
    } else {
      const int r = lanes.index() % 3;
      const Real b = vector_component(level.b, i, r);
      const Real residual = b - lane_sum_of_row(lanes, level.matrix, i, level.y).component();
      if (lanes.index() < 3) level.x[i].data()[r] = residual;
    }
  }
};

template <class Real>
struct CoarseCorrection {
  CoarseLevelView<Real> level, coarser;
  HYST_HD void operator()(int i) const { level.y[i] += coarser.finer[i].of(coarser.y); }
};

// Computes one number of y = inverse b, with a dense matrix of rows x stride numbers, row-major.
template <class Real>
struct DenseRow {
  const double* matrix;
  int stride, rows;
  const Real* b;
  Real* y;

  template <class Lanes>
  HYST_HD void operator()(int i, const Lanes& lanes) const {
    constexpr int kAtOnce = 8;
    const double* row = matrix + static_cast<std::size_t>(i) * stride;
    double part[kAtOnce] = {};
    for (int first = lanes.index(); first < rows; first += kAtOnce * Lanes::kCount)
      for (int k = 0; k < kAtOnce; ++k) {
        const int j = first + k * Lanes::kCount;
        if (j < rows) part[k] += row[j] * static_cast<double>(b[j]);
      }
    Vec<double, 1> sum = Vec<double, 1>::Zero();
    for (const double each : part) sum[0] += each;
    sum = lanes.lane_sum(sum);
    if (lanes.leads()) y[i] = static_cast<Real>(sum[0]);
  }
};

// Computes z = w D^-1 r + I y with the coarse levels' y, and r' z, after the step that yields r, if there is
// one.
template <class Real>
struct Combination {
  const char* held;           // n flags
  const Mat3<Real>* inverse;  // n blocks
  Real weight;
  const DeviceInterpolation<Real>* finer;  // null: there is no coarse level
  const Vec3<Real>* correction;
  const Vec3<Real>* r;
  Vec3<Real>* z;
  const PcgScalars* scalars;  // null: this is no iteration
  Advance<Real> step;         // without q: there is no step

  HYST_HD void operator()(int i, Sums<1>& sums) const {
    if (scalars && scalars->done) return;
    Vec3<Real> sum = Vec3<Real>::Zero();
    if (!held[i]) {
      if (step.q) step.move(i);
      sum = weight * (inverse[i] * r[i]);
      if (finer) sum += finer[i].of(correction);
    }
    z[i] = sum;
    sums.term[0] += static_cast<double>(r[i].dot(sum));
  }
};

// The loops of a cycle over some levels, for one launch (levels_in_one_launch.h).
template <class Real>
struct CycleView {
  static constexpr int kMax = 4;
  int levels = 0, swept = 0;  // the last level is inverted densely unless it is swept
  CoarseLevelView<Real> level[kMax] = {};
  DenseRow<Real> dense = {};
  Combination<Real> combination = {};  // the caller sets its r, z and scalars
};

}  // namespace hysteron
