// All iterations of a solve in one launch on a GPU, for cloth that is too small to fill it.
#pragma once

#include "sim/device/grid_team.h"
#include "sim/linear/cycle.h"
#include "sim/linear/pcg_loops.h"

namespace hysteron {

// Rows beyond which launches of their own are faster.
inline constexpr int kMostRowsInOneLaunch = 32768;

template <class Real>
struct PcgIterations {
  int rows;
  ProductTerms<Real> product;
  AdvanceTerms<Real> advance;
  Direction<Real> direction;
  const CycleView<Real>* cycle;  // of multigrid; null: the inverted diagonal blocks precondition
  PcgScalars* scalars;           // in the device's memory
};

// False: the caller orders them.
template <class Real>
bool iterate_in_one_launch(Cpu&, const PcgIterations<Real>&) {
  return false;
}

#ifdef __CUDACC__
template <class Real>
struct PcgTeam {
  PcgIterations<Real> of;
  CycleView<Real> cycle;

  // Every block keeps the numbers of the iteration, and finds the same.
  __device__ void operator()(GridTeam team) const {
    __shared__ PcgScalars own;
    if (threadIdx.x == 0) own = *of.scalars;
    __syncthreads();
    ProductTerms<Real> product = of.product;
    AdvanceTerms<Real> advance = of.advance;
    Direction<Real> direction = of.direction;
    product.scalars = advance.advance.scalars = direction.scalars = &own;
    while (!own.done) {
      const double curvature = team.row_sum(of.rows, product);
      if (threadIdx.x == 0) own.find_length(curvature);
      __syncthreads();
      const double residual = of.cycle ? preconditioned(team, advance.advance) : team.sum(of.rows, advance);
      if (threadIdx.x == 0) own.advance(residual);
      __syncthreads();
      if (!own.done) team.for_each(of.rows, direction);
    }
    if (blockIdx.x == 0 && threadIdx.x == 0) *of.scalars = own;
  }

 private:
  __device__ double preconditioned(GridTeam& team, const Advance<Real>& advance) const {
    team.for_each(of.rows, advance);
    cycle.run(team, advance.r);
    Combination<Real> combination = cycle.combination;
    combination.r = advance.r;
    combination.z = of.advance.z;
    combination.scalars = advance.scalars;
    return team.sum(of.rows, combination);
  }
};

template <class Real>
bool iterate_in_one_launch(Cuda& cuda, const PcgIterations<Real>& iterations) {
  if (cuda.batch || cuda.profile || !cuda.graphs || iterations.rows > kMostRowsInOneLaunch) return false;
  return for_grid_team(cuda, "solve: iterations",
                       PcgTeam<Real>{iterations, iterations.cycle ? *iterations.cycle : CycleView<Real>{}});
}
#endif

}  // namespace hysteron
