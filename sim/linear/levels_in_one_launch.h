// Runs preconditioners in one launch on a GPU: small levels of multigrid, none of which fills it, or fronts.
#pragma once

#include "sim/device/grid_team.h"
#include "sim/linear/cycle.h"
#include "sim/linear/front_rows.h"
#include "sim/linear/level_setup.h"

namespace hysteron {

// Above this number of rows separate launches are faster (on an H100 not yet for 66,000 rows, but for
// 150,000).
inline constexpr int kMaxRowsInOneLaunch = 80000;
// The largest level whose eigenvalue is found in one launch: warps take a row each.
inline constexpr int kMaxNodesInOneLaunch = kMaxRowsByWarps;

template <class Real>
struct OneLaunchView {
  enum Kind { kDiagonal, kCycle, kFronts };
  Kind kind = kDiagonal;  // the inverted diagonal blocks precondition
  CycleView<Real> cycle = {};
  FrontsView<Real> fronts = {};
};

inline bool may_take_one_launch(const Cpu&) { return false; }
// Returns false: the caller orders the loops, with the same bits.
template <class Real>
bool eigenvalues_in_one_launch(Cpu&, const CycleView<Real>&) {
  return false;
}

#ifdef __CUDACC__
// In a batch loops are shared with other cloths, and a profile times single loops: both exclude one launch.
inline bool may_take_one_launch(const Cuda& cuda) { return cuda.graphs && !cuda.batch && !cuda.profile; }

template <class Real>
struct EigenvaluesTeam {
  CycleView<Real> cycle;

  __device__ void operator()(GridTeam& team) const {
    for (int l = 0; l < cycle.swept; ++l) {
      const CoarseLevelView<Real>& v = cycle.level[l];
      team.for_each(v.nodes, RoughStart<Real>{v});
      for (int step = 1; step < kPowerSteps; ++step)
        team.for_each_row(v.nodes, PowerStep<Real>{v, step % 2 ? v.x : v.y, step % 2 ? v.y : v.x});
      Sums<2> total;
      for (int k = 0; k < 2; ++k) total.term[k] = team.template row_sum<Warp>(v.nodes, RayleighTerm{{v}, k});
      if (blockIdx.x == 0 && threadIdx.x == 0) *v.inverse_eigenvalue = inverse_eigenvalue(total);
    }
  }

 private:
  struct RayleighTerm {
    RayleighTerms<Real> terms;
    int which;
    __device__ void operator()(int i, const Warp& lanes, Sums<1>& sums) const {
      Sums<2> both;
      terms(i, lanes, both);
      sums.term[0] += both.term[which];
    }
  };
};

template <class Real>
bool eigenvalues_in_one_launch(Cuda& cuda, const CycleView<Real>& cycle) {
  return for_grid_team(cuda, "multigrid: eigenvalues", EigenvaluesTeam<Real>{cycle});
}

// Runs a cycle from the finer level's residual to the first level's y.
template <class Real>
__device__ void run_cycle(GridTeam& team, const CycleView<Real>& cycle, const NextResidual<Real>& residual) {
  for (int l = 0; l < cycle.levels; ++l) {
    const CoarseLevelView<Real>& v = cycle.level[l];
    const bool is_swept = l < cycle.swept;
    if (l == 0)
      for_each_block_row(team, v.nodes, Restriction<Real, NextResidual<Real>>{v, residual, is_swept});
    else
      for_each_block_row(team, v.nodes, Restriction<Real>{v, cycle.level[l - 1].x, is_swept});
    if (l == cycle.swept) {
      team.for_each_row(cycle.dense.rows, cycle.dense);
      break;
    }
    for_each_block_row(team, v.nodes, JacobiSweep<Real>{v, kSecondDamping, v.x, v.y});
    if (l + 1 < cycle.levels) for_each_block_row(team, v.nodes, LevelResidual<Real>{v});
  }
  for (int l = cycle.swept - 1; l >= 0; --l) {
    const CoarseLevelView<Real>& v = cycle.level[l];
    if (l + 1 < cycle.levels) team.for_each(v.nodes, CoarseCorrection<Real>{v, cycle.level[l + 1]});
    for_each_block_row(team, v.nodes, JacobiSweep<Real>{v, kFirstDamping, v.y, v.x});
    for_each_block_row(team, v.nodes, JacobiSweep<Real>{v, kSecondDamping, v.x, v.y});
  }
}
#endif

}  // namespace hysteron
