// Several loops, each over what the one before it has written, in one launch: for work too small to fill a
// GPU.
#pragma once

#include "sim/device/rows.h"
#ifdef __CUDACC__
#include <cooperative_groups.h>
#endif

namespace hysteron {

// The CPU's threads.
class CpuTeam {
 public:
  CpuTeam(Cpu& cpu, const Kernel& kernel) : cpu_(cpu), kernel_(kernel) {}
  // All see what body(i), i in [0, n), has written when this returns.
  template <class Body>
  void for_each(int n, const Body& body) const {
    hysteron::for_each(cpu_, kernel_, n, body);
  }
  template <class Body>
  void for_each_row(int rows, const Body& body) const {
    hysteron::for_each_row(cpu_, kernel_, rows, body);
  }

 private:
  Cpu& cpu_;
  const Kernel& kernel_;
};

// Runs body(t, team) for t in [0, teams); no team sees what another one writes.  `stop` as in for_each_row().
template <class Body>
void for_each_team(Cpu& cpu, const Kernel& kernel, int teams, const Body& body,
                   const int* /*stop*/ = nullptr) {
  for (int t = 0; t < teams; ++t) body(t, CpuTeam(cpu, kernel));
}

#ifdef __CUDACC__
// Blocks that wait for one another: a cluster of Hopper's, on older GPUs a single block.
class CudaTeam {
 public:
  template <class Body>
  HYST_HD void for_each(int n, const Body& body) const {
    for (int i = threadIdx.x * blocks() + block(); i < n; i += blockDim.x * blocks()) body(i);
    wait();
  }
  template <class Body>
  HYST_HD void for_each_row(int rows, const Body& body) const {
    const int warp = threadIdx.x / Warp::kCount, warps = blockDim.x / Warp::kCount;
    for (int i = warp * blocks() + block(); i < rows; i += warps * blocks()) body(i, Warp{});
    wait();
  }
  static HYST_HD int blocks() {
#if __CUDA_ARCH__ >= 900
    return cooperative_groups::this_cluster().num_blocks();
#else
    return 1;
#endif
  }

 private:
  static HYST_HD int block() {
#if __CUDA_ARCH__ >= 900
    return cooperative_groups::this_cluster().block_rank();
#else
    return 0;
#endif
  }
  static HYST_HD void wait() {
#if __CUDA_ARCH__ >= 900
    cooperative_groups::this_cluster().sync();
#elif defined(__CUDA_ARCH__)
    __syncthreads();
#endif
  }
};

inline constexpr int kTeamBlocks = 8;  // the largest cluster that every GPU with clusters has
inline constexpr int kTeamThreads = 1024;
// In a batch, whose teams fill the GPU together, a team is one small block.  Its bits are the same.
inline constexpr int kBatchedTeamThreads = 256;

template <class Body>
struct TeamLoop {
  unsigned blocks;
  Body body;
  const int* stop;

  __device__ void operator()() const {
    if (stop && *stop) return;
    const CudaTeam team;
    body(blockIdx.x / team.blocks(), team);
  }
};

template <class Loop>
__global__ void __launch_bounds__(kTeamThreads) team_kernel(const __grid_constant__ Loop loop) {
  loop();
}

template <class Loop>
__global__ void __launch_bounds__(kBatchedTeamThreads) batched_team_kernel(const BatchedLoop* ordered) {
  run_batched<Loop>(ordered);
}

// Blocks of a team on this GPU, by what the kernel was compiled for.
template <class Loop>
unsigned blocks_of_team(void (*kernel)(Loop)) {
  cudaFuncAttributes compiled{};
  check_cuda(cudaFuncGetAttributes(&compiled, kernel), "team");
  constexpr int kHopper = 90;
  return compiled.ptxVersion >= kHopper ? kTeamBlocks : 1;
}

template <class Body>
void launch_teams(Cuda& cuda, const Kernel& kernel, const TeamLoop<Body>& loop, unsigned team_blocks) {
  cudaLaunchAttribute cluster{};
  cluster.id = cudaLaunchAttributeClusterDimension;
  cluster.val.clusterDim = {team_blocks, 1, 1};
  cudaLaunchConfig_t config{};
  config.gridDim = loop.blocks;
  config.blockDim = kTeamThreads;
  config.stream = cuda.stream;
  config.attrs = &cluster;
  config.numAttrs = team_blocks > 1 ? 1 : 0;
  check_cuda(cudaLaunchKernelEx(&config, team_kernel<TeamLoop<Body>>, loop), kernel.name);
}

template <class Body>
void for_each_team(Cuda& cuda, const Kernel& kernel, int teams, const Body& body, const int* stop = nullptr) {
  if (teams == 0) return;
  using Loop = TeamLoop<Body>;
  ++device_counts.loops;
  if (cuda.batch) {
    constexpr CudaBatch::Launch kBatched = [](const BatchedLoop* ordered, unsigned blocks, unsigned members,
                                              cudaStream_t stream) {
      batched_team_kernel<Loop><<<dim3(blocks, members), kBatchedTeamThreads, 0, stream>>>(ordered);
    };
    return cuda.batch->order(kBatched, kernel.name, Loop{static_cast<unsigned>(teams), body, stop});
  }
  const Profiled<Cuda> profiled(cuda, kernel);
  const unsigned team_blocks = blocks_of_team(team_kernel<Loop>);
  launch_teams(cuda, kernel, Loop{teams * team_blocks, body, stop}, team_blocks);
}
#endif

}  // namespace hysteron
