// An NVIDIA GPU as a device.  Included under nvcc only; every launch and call is checked.
#pragma once

#include <cuda_runtime.h>

#include <string>
#include <vector>

#include "sim/base/error.h"
#include "sim/device/cpu.h"

namespace hysteron {

inline constexpr int kThreadsPerBlock = 128;

inline void check_cuda(cudaError_t status, const char* name) {
  if (status != cudaSuccess)
    throw Error::machine(std::string("GPU: ") + name + ": " + cudaGetErrorString(status));
}

template <>
class KernelProfile<struct Cuda>;

struct Cuda {
  static constexpr bool kGpu = true;
  static constexpr std::size_t kStaged = 4096;  // the most bytes of a download through `staging`
  int index = 0;                                // among the CUDA devices
  cudaStream_t stream = nullptr;
  std::size_t bytes = 0;
  double* partial = nullptr;  // scratch of for_each_sum, one slot per block and term
  int partial_size = 0;
  unsigned* arrived = nullptr;  // blocks that have delivered their partial sums
  void* staging = nullptr;      // pinned memory of the host
  bool graphs;                  // loops may be graphs (while_loop.h); HYSTERON_CUDA_GRAPHS=0: none
  std::unique_ptr<KernelProfile<Cuda>> profile;

  explicit Cuda(int device);
  ~Cuda();
  Cuda(const Cuda&) = delete;
  Cuda& operator=(const Cuda&) = delete;
  std::string description() const;
  int cuda_device() const { return index; }
  void synchronize() const {
    ++device_counts.synchronizations;
    check_cuda(cudaStreamSynchronize(stream), "synchronize");
  }
};

// Number of usable GPUs; why there are none goes to `reason`.
int cuda_device_count(std::string& reason);

// Events around every launch, which the host reads when many are pending or their costs are asked for; NVTX
// ranges where the toolkit has them.  A launch on an idle GPU takes as long as the host takes to send it.
template <>
class KernelProfile<Cuda> {
 public:
  explicit KernelProfile(Cuda& cuda);
  ~KernelProfile();
  KernelProfile(const KernelProfile&) = delete;
  KernelProfile& operator=(const KernelProfile&) = delete;
  void begin(const Kernel& kernel);
  void end(const Kernel& kernel);
  KernelCosts costs();  // so far

 private:
  void collect();
  Cuda& cuda_;
  std::vector<cudaEvent_t> event_;  // two for each pending launch
  std::vector<Kernel> pending_;
  KernelCosts costs_;
};

template <class Body>
__global__ void for_each_kernel(int n, const Body body) {
  const int i = blockIdx.x * blockDim.x + threadIdx.x;
  if (i < n) body(i);
}

template <class Body>
void for_each(Cuda& cuda, const Kernel& kernel, int n, const Body& body) {
  if (n == 0) return;
  ++device_counts.loops;
  const Profiled<Cuda> profiled(cuda, kernel);
  const int blocks = (n + kThreadsPerBlock - 1) / kThreadsPerBlock;
  for_each_kernel<<<blocks, kThreadsPerBlock, 0, cuda.stream>>>(n, body);
  check_cuda(cudaGetLastError(), kernel.name);
}

// Tree sum over the block in a fixed order; the result is valid in thread 0.
template <int K>
__device__ void block_sum(Sums<K>& sums) {
  __shared__ double shared[K][kThreadsPerBlock / 32];
  for (int k = 0; k < K; ++k)
    for (int offset = 16; offset > 0; offset /= 2)
      sums.term[k] += __shfl_down_sync(0xffffffffu, sums.term[k], offset);
  __syncthreads();
  if (threadIdx.x % 32 == 0)
    for (int k = 0; k < K; ++k) shared[k][threadIdx.x / 32] = sums.term[k];
  __syncthreads();
  if (threadIdx.x == 0)
    for (int k = 0; k < K; ++k)
      for (int w = 1; w < kThreadsPerBlock / 32; ++w) sums.term[k] += shared[k][w];
}

// One launch: the block that arrives last adds all partial sums in block order, so the bits do not depend on
// the order in which blocks ran.
template <int K, class Body, class Finish>
__global__ void for_each_sum_kernel(int n, const Body body, const Finish finish, double* partial,
                                    unsigned* arrived) {
  Sums<K> sums;
  for (int i = blockIdx.x * blockDim.x + threadIdx.x; i < n; i += gridDim.x * blockDim.x) body(i, sums);
  block_sum(sums);
  __shared__ bool last;
  if (threadIdx.x == 0) {
    for (int k = 0; k < K; ++k) partial[blockIdx.x * K + k] = sums.term[k];
    __threadfence();
    last = atomicAdd(arrived, 1u) == gridDim.x - 1;
  }
  __syncthreads();
  if (!last) return;
  __threadfence();
  Sums<K> total;
  for (int b = threadIdx.x; b < static_cast<int>(gridDim.x); b += blockDim.x)
    for (int k = 0; k < K; ++k) total.term[k] += __ldcg(&partial[b * K + k]);
  block_sum(total);
  if (threadIdx.x == 0) {
    *arrived = 0;
    finish(total);
  }
}

inline constexpr int kSumBlocks =
    528;  // four blocks for each multiprocessor of an H100; fixed for the bits' sake

template <int K, class Body, class Finish>
void for_each_sum(Cuda& cuda, const Kernel& kernel, int n, const Body& body, const Finish& finish) {
  ++device_counts.loops;
  if (cuda.partial_size < kSumBlocks * K) {
    ++device_counts.allocations;
    if (cuda.partial) check_cuda(cudaFree(cuda.partial), kernel.name);
    check_cuda(cudaMalloc(&cuda.partial, sizeof(double) * kSumBlocks * K), kernel.name);
    cuda.partial_size = kSumBlocks * K;
  }
  const Profiled<Cuda> profiled(cuda, kernel);
  int blocks = (n + kThreadsPerBlock - 1) / kThreadsPerBlock;
  blocks = blocks < 1 ? 1 : (blocks > kSumBlocks ? kSumBlocks : blocks);
  for_each_sum_kernel<K>
      <<<blocks, kThreadsPerBlock, 0, cuda.stream>>>(n, body, finish, cuda.partial, cuda.arrived);
  check_cuda(cudaGetLastError(), kernel.name);
}

inline void* device_allocate(Cuda& cuda, std::size_t bytes) {
  ++device_counts.allocations;
  void* memory = nullptr;
  check_cuda(cudaMalloc(&memory, bytes), "allocate");
  check_cuda(cudaMemsetAsync(memory, 0, bytes, cuda.stream), "allocate");
  cuda.bytes += bytes;
  return memory;
}
inline void device_free(Cuda& cuda, void* memory, std::size_t bytes) {
  cuda.bytes -= bytes;
  cudaFree(memory);
}
inline void device_upload(Cuda& cuda, void* to, const void* from, std::size_t bytes) {
  check_cuda(cudaMemcpyAsync(to, from, bytes, cudaMemcpyHostToDevice, cuda.stream), "upload");
  cuda.synchronize();
}
// The driver copies what is small much faster into pinned memory.
inline void device_download(Cuda& cuda, void* to, const void* from, std::size_t bytes) {
  void* target = bytes <= Cuda::kStaged ? cuda.staging : to;
  check_cuda(cudaMemcpyAsync(target, from, bytes, cudaMemcpyDeviceToHost, cuda.stream), "download");
  cuda.synchronize();
  if (target != to) std::memcpy(to, target, bytes);
}
// Pinned memory of the host, which loops can write.
inline void* host_allocate(Cuda&, std::size_t bytes) {
  ++device_counts.allocations;
  void* memory = nullptr;
  check_cuda(cudaHostAlloc(&memory, bytes, cudaHostAllocDefault), "allocate on the host");
  return memory;
}
inline void host_free(Cuda&, void* memory) { cudaFreeHost(memory); }

}  // namespace hysteron
