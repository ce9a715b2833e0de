// Runs all iterations of a solve in one launch on a GPU, for cloth that is too small to fill it.
#pragma once

#include "sim/device/grid_team.h"
#include "sim/linear/levels_in_one_launch.h"
#include "sim/linear/preconditioner.h"
#include "sim/linear/row_products.h"

namespace hysteron {

// These are the loops of an iteration of conjugate gradients, row by row.

// Computes q = A p, and p' q.
template <class Real, bool kHasPairs = true>
struct ProductTerms {
  SystemProduct<Real, kHasPairs> product;
  const char* held;
  const Vec3<Real>* p;
  Vec3<Real>* q;
  const PcgScalars* scalars;

  template <class Lanes>
  HYST_HD void operator()(int i, const Lanes& lanes, Sums<1>& sums) const {
    if (scalars->done) return;
    if (held[i]) {
      if (lanes.leads()) q[i] = Vec3<Real>::Zero();
      return;
    }
    const Vec3<Real> row = product.at(lanes, i, p);
    if (!lanes.leads()) return;
    q[i] = row;
    sums.term[0] += static_cast<double>(p[i].dot(row));
  }
};

// Takes a step, and computes z = D^-1 r and r' z.
template <class Real>
struct AdvanceTerms {
  Advance<Real> advance;
  const Mat3<Real>* inverse;  // n inverted diagonal blocks
  Vec3<Real>* z;

  HYST_HD void operator()(int i, Sums<1>& sums) const {
    if (advance.scalars->done || advance.held[i]) return;
    advance.move(i);
    const Vec3<Real> residual = advance.r[i], preconditioned = inverse[i] * residual;
    z[i] = preconditioned;
    sums.term[0] += static_cast<double>(residual.dot(preconditioned));
  }
};

// Computes the next direction.
template <class Real>
struct Direction {
  const char* held;
  const Vec3<Real>* z;
  Vec3<Real>* p;
  const PcgScalars* scalars;

  HYST_HD void operator()(int i) const {
    if (scalars->done || held[i]) return;
    p[i] = z[i] + static_cast<Real>(scalars->beta) * p[i];
  }
};

template <class Real>
struct PcgIterations {
  int rows;
  ProductTerms<Real> product;
  AdvanceTerms<Real> advance;
  Direction<Real> direction;
  Vec3<Real>* other_p;  // in one launch, directions are in p and here in turn
  PcgScalars* scalars;  // in the device's memory
};

// Returns false: the caller orders the loops.
template <class Real>
bool iterate_in_one_launch(Cpu&, const PcgIterations<Real>&, const OneLaunchView<Real>&) {
  return false;
}

#ifdef __CUDACC__
// Computes the next direction p, q = A p, and p' q.  A row computes its neighbours' p itself, so that no
// separate loop is needed.
template <class Real>
struct NextProduct {
  SystemProduct<Real> product;
  const char* held;
  NextDirection<Real> next;
  Vec3<Real>*p, *q;

  template <class Lanes>
  __device__ void operator()(int i, const Lanes& lanes, Sums<1>& sums) const {
    if (held[i]) {
      if (lanes.leads()) p[i] = q[i] = Vec3<Real>::Zero();
      return;
    }
    const Vec3<Real> row = product.at(lanes, i, next);
    if (!lanes.leads()) return;
    const Vec3<Real> direction = next[i];
    p[i] = direction;
    q[i] = row;
    sums.term[0] += static_cast<double>(direction.dot(row));
  }
};

template <class Real>
struct PcgTeam {
  PcgIterations<Real> of;
  OneLaunchView<Real> preconditioner;

  // Every thread keeps the numbers of the iteration, and computes the same.
  __device__ void operator()(GridTeam& team) const {
    PcgScalars own = *of.scalars;
    own.beta = 0;  // the first direction is known
    AdvanceTerms<Real> advance = of.advance;
    advance.advance.scalars = &own;
    Vec3<Real>*before = of.direction.p, *p = of.other_p;
    while (!own.done) {
      const NextDirection<Real> next{of.direction.z, before, static_cast<Real>(own.beta)};
      own.find_length(block_row_sum(
          team, of.rows, NextProduct<Real>{of.product.product, of.direction.held, next, p, of.product.q}));
      advance.advance.p = p;
      own.advance(preconditioner.kind == OneLaunchView<Real>::kDiagonal
                      ? team.sum(of.rows, advance)
                      : preconditioned(team, advance.advance));
      Vec3<Real>* const last = p;
      p = before;
      before = last;
    }
    if (blockIdx.x == 0 && threadIdx.x == 0) *of.scalars = own;
  }

 private:
  __device__ double preconditioned(GridTeam& team, const Advance<Real>& advance) const {
    if (preconditioner.kind == OneLaunchView<Real>::kFronts) {
      team.for_each(of.rows, advance);
      return run_fronts(team, preconditioner.fronts, advance.r, of.advance.z, advance.scalars);
    }
    run_cycle(team, preconditioner.cycle, NextResidual<Real>{advance});
    Combination<Real> combination = preconditioner.cycle.combination;
    combination.r = advance.r;
    combination.z = of.advance.z;
    combination.scalars = advance.scalars;
    combination.step = advance;
    return team.sum(of.rows, combination);
  }
};

template <class Real>
bool iterate_in_one_launch(Cuda& cuda, const PcgIterations<Real>& iterations,
                           const OneLaunchView<Real>& preconditioner) {
  if (!may_take_one_launch(cuda) || iterations.rows > kMaxRowsInOneLaunch) return false;
  return for_grid_team(cuda, "solve: iterations", PcgTeam<Real>{iterations, preconditioner});
}
#endif

}  // namespace hysteron
