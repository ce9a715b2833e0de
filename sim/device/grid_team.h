// An algorithm of many short loops in one launch: as many blocks as a GPU runs at once share every loop and
// wait for one another behind it, which takes a microsecond where a launch takes several.  Sums have the bits
// of for_each_sum() and for_each_row_sum(), whose blocks these take in groups of threads.
#pragma once

#include "sim/device/rows.h"
#ifdef __CUDACC__
#include <cooperative_groups.h>

namespace hysteron {

class GridTeam {
 public:
  static constexpr int kThreads = 1024;
  static constexpr int kGroups = kThreads / kThreadsPerBlock;  // of a block
  // Numbers of scratch: two sums of one term, since a block may be late to read the first.
  static constexpr int kScratch = 2 * kRowSumBlocks;

  explicit __device__ GridTeam(double* scratch) : scratch_(scratch) {}

  template <class Body>
  __device__ void for_each(int n, const Body& body) const {
    for (int i = blockIdx.x * kThreads + threadIdx.x; i < n; i += gridDim.x * kThreads) body(i);
    wait();
  }
  template <class Body>
  __device__ void for_each_row(int rows, const Body& body) const {
    constexpr int kWarps = kThreads / Warp::kCount;
    // Neighbouring rows go to different multiprocessors: few rows use all of them.
    const int warp = threadIdx.x / Warp::kCount * gridDim.x + blockIdx.x;
    for (int i = warp; i < rows; i += gridDim.x * kWarps) body(i, Warp{});
    wait();
  }
  // The total, in every thread.
  template <class Body>
  __device__ double sum(int n, const Body& body) {
    return sum_of_blocks(n, sum_blocks(n, kThreadsPerBlock, kSumBlocks), body);
  }
  template <class Body>
  __device__ double row_sum(int rows, const Body& body) {
    return sum_of_blocks(rows * Warp::kCount, sum_blocks(rows, kRowsPerBlock, kRowSumBlocks),
                         LaneOfRow<Body>{body});
  }

 private:
  static __device__ int group() { return threadIdx.x / kThreadsPerBlock; }
  static __device__ int rank() { return threadIdx.x % kThreadsPerBlock; }
  static __device__ void wait() { cooperative_groups::this_grid().sync(); }
  // As block_sum(), of each group: valid in its first thread.  All threads of the block call it.
  static __device__ double group_sum(double term) {
    __shared__ double shared[kGroups][kThreadsPerBlock / Warp::kCount];
    for (int offset = 16; offset > 0; offset /= 2) term += __shfl_down_sync(0xffffffffu, term, offset);
    __syncthreads();
    if (rank() % Warp::kCount == 0) shared[group()][rank() / Warp::kCount] = term;
    __syncthreads();
    if (rank() == 0)
      for (int w = 1; w < kThreadsPerBlock / Warp::kCount; ++w) term += shared[group()][w];
    return term;
  }

  template <class Body>
  __device__ double sum_of_blocks(int n, int blocks, const Body& body) {
    double* partial = scratch_ + (turn_ ^= 1) * kRowSumBlocks;
    for (int first = 0; first < blocks; first += gridDim.x * kGroups) {
      const int b = first + group() * gridDim.x + blockIdx.x;
      Sums<1> sums;
      if (b < blocks)
        for (int i = b * kThreadsPerBlock + rank(); i < n; i += blocks * kThreadsPerBlock) body(i, sums);
      const double term = group_sum(sums.term[0]);
      if (b < blocks && rank() == 0) partial[b] = term;
    }
    wait();
    __shared__ double total;
    double term = 0;
    if (group() == 0)
      for (int b = rank(); b < blocks; b += kThreadsPerBlock) term += __ldcg(&partial[b]);
    term = group_sum(term);
    if (threadIdx.x == 0) total = term;
    __syncthreads();
    const double result = total;
    __syncthreads();
    return result;
  }

  double* scratch_;
  int turn_ = 0;
};

template <class Body>
__global__ void __launch_bounds__(GridTeam::kThreads)
    grid_team_kernel(const __grid_constant__ Body body, double* scratch) {
  body(GridTeam(scratch));
}

// Runs body(team) if the GPU can; false: it cannot.  Nothing may have been ordered in a batch.
template <class Body>
bool for_grid_team(Cuda& cuda, const Kernel& kernel, const Body& body) {
  int can = 0, processors = 0;
  check_cuda(cudaDeviceGetAttribute(&can, cudaDevAttrCooperativeLaunch, cuda.index), kernel.name);
  check_cuda(cudaDeviceGetAttribute(&processors, cudaDevAttrMultiProcessorCount, cuda.index), kernel.name);
  if (!can) return false;
  cuda.reserve_partial(GridTeam::kScratch, kernel.name);
  ++device_counts.loops;
  const Profiled<Cuda> profiled(cuda, kernel);
  cudaLaunchAttribute together{};
  together.id = cudaLaunchAttributeCooperative;
  together.val.cooperative = 1;
  cudaLaunchConfig_t config{};
  config.gridDim = processors;
  config.blockDim = GridTeam::kThreads;
  config.stream = cuda.stream;
  config.attrs = &together;
  config.numAttrs = 1;
  check_cuda(cudaLaunchKernelEx(&config, grid_team_kernel<Body>, body, cuda.partial), kernel.name);
  return true;
}

}  // namespace hysteron
#endif
