// Runs an algorithm of many short loops in one launch: as many blocks as a GPU runs at once share every loop
// and wait for one another behind it, which takes a microsecond where a launch takes several. Sums have the
// bits of for_each_sum() and for_each_row_sum(), whose blocks these take in groups of threads.
#pragma once

#include "sim/device/rows.h"
#ifdef __CUDACC__

namespace hysteron {

// A barrier for the blocks of a launch, in memory that is zero before it and after leave().
class GridBarrier {
 public:
  explicit __device__ GridBarrier(unsigned* arrived) : arrived_(arrived) {}

  // Makes every thread wait until all blocks have come, and see their earlier writes.
  __device__ void wait() {
    __syncthreads();
    expected_ += gridDim.x;  // stays below 2^32 for some 10^7 waits
    if (threadIdx.x == 0) {
      asm volatile("red.release.gpu.global.add.u32 [%0], 1;" ::"l"(arrived_) : "memory");
      unsigned now;
      do asm volatile("ld.acquire.gpu.global.u32 %0, [%1];" : "=r"(now) : "l"(arrived_) : "memory");
      while (now < expected_);
    }
    __syncthreads();
  }
  // Ends the use of the barrier: no thread may wait after it.  The second number counts blocks that have
  // left.
  __device__ void leave() {
    if (threadIdx.x == 0 && atomicAdd(arrived_ + 1, 1u) == gridDim.x - 1) arrived_[0] = arrived_[1] = 0;
  }

 private:
  unsigned* arrived_;
  unsigned expected_ = 0;
};

class GridTeam {
 public:
  static constexpr int kThreads = 1024;
  static constexpr int kGroups = kThreads / kThreadsPerBlock;  // per block
  // The size of the scratch: two sums of one term, since a block may be late to read the first.
  static constexpr int kScratch = 2 * kRowSumBlocks;

  __device__ GridTeam(double* scratch, unsigned* arrived) : scratch_(scratch), barrier_(arrived) {}
  __device__ void leave() { barrier_.leave(); }  // every thread's last call

  template <class Body>
  __device__ void for_each(int n, const Body& body) {
    for (int i = blockIdx.x * kThreads + threadIdx.x; i < n; i += gridDim.x * kThreads) body(i);
    barrier_.wait();
  }
  template <class Lanes = Warp, class Body>
  __device__ void for_each_row(int rows, const Body& body) {
    constexpr int kWarps = kThreads / Warp::kCount;
    // Neighbouring rows go to different multiprocessors, so that few rows use all of them.
    const int first = threadIdx.x / Warp::kCount * gridDim.x + blockIdx.x;
    for (int warp = first; warp < warps_for<Lanes>(rows); warp += gridDim.x * kWarps)
      run_on_warp_row<Lanes>(warp, rows, body);
    barrier_.wait();
  }
  // Returns the total, in every thread.
  template <class Body>
  __device__ double sum(int n, const Body& body) {
    return sum_of_blocks(n, sum_blocks(n, kThreadsPerBlock, kSumBlocks), body);
  }
  template <class Lanes, class Body>
  __device__ double row_sum(int rows, const Body& body) {
    const int warps = warps_for<Lanes>(rows);
    return sum_of_blocks(warps * Warp::kCount, sum_blocks(warps, kWarpsPerBlock, kRowSumBlocks),
                         LaneOfRow<Lanes, Body>{rows, body});
  }

 private:
  static __device__ int group() { return threadIdx.x / kThreadsPerBlock; }
  static __device__ int rank() { return threadIdx.x % kThreadsPerBlock; }
  // Sums over each group like block_sum(): the result is valid in its first thread.  All threads of the block
  // call it.
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
    barrier_.wait();
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
  GridBarrier barrier_;
  int turn_ = 0;
};

template <class Body>
__global__ void __launch_bounds__(GridTeam::kThreads)
    grid_team_kernel(const __grid_constant__ Body body, double* scratch, unsigned* arrived) {
  GridTeam team(scratch, arrived);
  body(team);
  team.leave();
}

// Runs body(team) and returns true if the GPU can run it.  No orders of a batch may be pending.
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
  check_cuda(cudaLaunchKernelEx(&config, grid_team_kernel<Body>, body, cuda.partial, cuda.arrived),
             kernel.name);
  return true;
}

}  // namespace hysteron
#endif
