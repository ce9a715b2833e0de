// An NVIDIA GPU as a device.  Included under nvcc only; every launch and call is checked.
#pragma once

#include <cuda_runtime.h>

#include <string>
#include <vector>

#include "sim/base/error.h"
#include "sim/device/cpu.h"
#include "sim/device/cuda_batch.h"

namespace hysteron {

inline constexpr int kThreadsPerBlock = 128;

inline void check_cuda(cudaError_t status, const char* name) {
  if (status != cudaSuccess)
    throw Error::system(std::string("GPU: ") + name + ": " + cudaGetErrorString(status));
}

template <>
class KernelProfile<struct Cuda>;

struct Cuda {
  static constexpr bool kGpu = true;
  static constexpr std::size_t kStaged = 4096;  // the most bytes of a download through `staging`
  int index = 0;                                // among the CUDA devices
  CudaBatch* batch = nullptr;                   // it launches the loops; null: each is launched at once
  cudaStream_t stream = nullptr;
  std::size_t bytes = 0;
  double* partial = nullptr;  // scratch of for_each_sum(), one slot per block and term
  int partial_size = 0;
  unsigned* arrived = nullptr;  // number of blocks that have delivered their partial sums
  void* staging = nullptr;      // pinned memory of the host
  bool graphs;                  // loops may be graphs (while_loop.h); HYSTERON_CUDA_GRAPHS=0: none
  bool early_blocks;            // does grid_dependency_wait() work?
  std::unique_ptr<KernelProfile<Cuda>> profile;

  explicit Cuda(int device);
  ~Cuda();
  Cuda(const Cuda&) = delete;
  Cuda& operator=(const Cuda&) = delete;
  std::string description() const;
  int cuda_device() const { return index; }
  // Releases, by cudaFree or cudaFreeHost, memory that ordered loops may still use.
  void release(void* memory, CudaBatch::Release by) const {
    if (batch)
      batch->release_later(memory, by);
    else
      by(memory);
  }
  // Reserves scratch of sums for at least so many numbers.
  void reserve_partial(int numbers, const char* name);
  void synchronize() const {
    ++device_counts.synchronizations;
    if (batch) return batch->wait();
    check_cuda(cudaStreamSynchronize(stream), "synchronize");
  }
};

// Returns the number of usable GPUs; `reason` says why there are none.
int cuda_device_count(std::string& reason);

// Profiles by events around every launch, which the host reads when many are pending or their costs are asked
// for, and by NVTX ranges where the toolkit has them.  A launch on an idle GPU takes as long as the host
// takes to send it.
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
  std::vector<cudaEvent_t> event_;  // two per pending launch
  std::vector<Kernel> pending_;
  KernelCosts costs_;
};

// Loops of more blocks fill a GPU by themselves: with early blocks a copy of 131,072 blocks took 168 us in
// place of 101.
inline constexpr unsigned kMaxEarlyBlocks = 4096;

// Where a GPU can, a loop's blocks start while the last ones of the loop before are at work, so that they are
// there when it ends (programmatic dependent launch): here they wait for its end, and let the next loop's
// blocks start.  Every kernel that is launched so calls it first.
__device__ inline void grid_dependency_wait() {
#if __CUDA_ARCH__ >= 900
  if (gridDim.x > kMaxEarlyBlocks) return;
  asm volatile("griddepcontrol.wait;" ::: "memory");
  asm volatile("griddepcontrol.launch_dependents;" ::: "memory");
#endif
}

// A loop is an object that a kernel takes by value; its blocks are part of it.
template <class Loop>
__global__ void loop_kernel(const Loop loop) {
  grid_dependency_wait();
  loop();
}

template <class Loop>
__global__ void batched_loop_kernel(const BatchedLoop* ordered) {
  run_batched<Loop>(ordered);
}

template <class Loop>
void launch_now(Cuda& cuda, const Kernel& kernel, const Loop& loop) {
  const Profiled<Cuda> profiled(cuda, kernel);
  cudaLaunchAttribute early{};
  early.id = cudaLaunchAttributeProgrammaticStreamSerialization;
  early.val.programmaticStreamSerializationAllowed = 1;
  cudaLaunchConfig_t config{};
  config.gridDim = loop.blocks;
  config.blockDim = kThreadsPerBlock;
  config.stream = cuda.stream;
  config.attrs = &early;
  config.numAttrs = cuda.early_blocks && loop.blocks <= kMaxEarlyBlocks ? 1 : 0;
  check_cuda(cudaLaunchKernelEx(&config, loop_kernel<Loop>, loop), kernel.name);
}

template <class Loop>
void launch(Cuda& cuda, const Kernel& kernel, const Loop& loop) {
  ++device_counts.loops;
  if (cuda.batch) {
    constexpr CudaBatch::Launch kBatched = [](const BatchedLoop* ordered, unsigned blocks, unsigned members,
                                              cudaStream_t stream) {
      batched_loop_kernel<Loop><<<dim3(blocks, members), kThreadsPerBlock, 0, stream>>>(ordered);
    };
    return cuda.batch->order(kBatched, kernel.name, loop);
  }
  launch_now(cuda, kernel, loop);
}

inline unsigned blocks_for(int n, int per_block = kThreadsPerBlock) {
  return (n + per_block - 1) / per_block;
}

template <class Body>
struct EachLoop {
  unsigned blocks;
  int n;
  Body body;

  __device__ void operator()() const {
    const int i = blockIdx.x * blockDim.x + threadIdx.x;
    if (i < n) body(i);
  }
};

template <class Body>
void for_each(Cuda& cuda, const Kernel& kernel, int n, const Body& body) {
  if (n > 0) launch(cuda, kernel, EachLoop<Body>{blocks_for(n), n, body});
}

// In a batch this launches at once, behind the loops that this member has ordered.
template <class Body>
void for_each_alone(Cuda& cuda, const Kernel& kernel, int n, const Body& body) {
  if (n == 0) return;
  if (cuda.batch) cuda.batch->send();
  ++device_counts.loops;
  launch_now(cuda, kernel, EachLoop<Body>{blocks_for(n), n, body});
}

// Sums over the block as a tree, in a fixed order; the result is valid in thread 0.
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

// Sums in one launch: the block that arrives last adds all partial sums in block order, so the bits do not
// depend on the order in which blocks ran.
template <int K, class Body, class Finish>
struct SumLoop {
  unsigned blocks;
  int n;
  Body body;
  Finish finish;
  double* partial;
  unsigned* arrived;

  __device__ void operator()() const {
    Sums<K> sums;
    for (int i = blockIdx.x * blockDim.x + threadIdx.x; i < n; i += blocks * blockDim.x) body(i, sums);
    block_sum(sums);
    __shared__ bool last;
    if (threadIdx.x == 0) {
      for (int k = 0; k < K; ++k) partial[blockIdx.x * K + k] = sums.term[k];
      __threadfence();
      last = atomicAdd(arrived, 1u) == blocks - 1;
    }
    __syncthreads();
    if (!last) return;
    __threadfence();
    Sums<K> total;
    for (int b = threadIdx.x; b < static_cast<int>(blocks); b += blockDim.x)
      for (int k = 0; k < K; ++k) total.term[k] += __ldcg(&partial[b * K + k]);
    block_sum(total);
    if (threadIdx.x == 0) {
      *arrived = 0;
      finish(total);
    }
  }
};

// Four blocks for each multiprocessor of an H100; the number is fixed so that the bits are.
inline constexpr int kSumBlocks = 528;

// Returns the number of blocks of a sum of n elements or rows with `per_block` each, at most `most`, for
// which there is scratch.
HYST_HD inline int sum_blocks(int n, int per_block, int most) {
  const int blocks = (n + per_block - 1) / per_block;
  return blocks < 1 ? 1 : blocks < most ? blocks : most;
}

template <int K, class Body, class Finish>
void launch_sum(Cuda& cuda, const Kernel& kernel, int n, unsigned blocks, int most, const Body& body,
                const Finish& finish) {
  cuda.reserve_partial(most * K, kernel.name);
  launch(cuda, kernel, SumLoop<K, Body, Finish>{blocks, n, body, finish, cuda.partial, cuda.arrived});
}

template <int K, class Body, class Finish>
void for_each_sum(Cuda& cuda, const Kernel& kernel, int n, const Body& body, const Finish& finish,
                  int blocks_each = 1) {
  const int most = blocks_each * kSumBlocks;
  launch_sum<K>(cuda, kernel, n, sum_blocks(n, kThreadsPerBlock, most), most, body, finish);
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
  cuda.release(memory, cudaFree);
}

struct CopyLoop {
  unsigned blocks;
  int size;  // [bytes]
  const char* from;
  char* to;

  __device__ void operator()() const {
    const int i = blockIdx.x * blockDim.x + threadIdx.x;
    if (i < size) to[i] = from[i];
  }
};

// Copies few bytes between places that the GPU can reach.
inline void copy_in_batch(Cuda& cuda, const char* name, void* to, const void* from, std::size_t bytes) {
  const int size = static_cast<int>(bytes);
  launch(cuda, name,
         CopyLoop{blocks_for(size), size, static_cast<const char*>(from), static_cast<char*>(to)});
}

// In a batch small data travels with the loops.
inline void device_upload(Cuda& cuda, void* to, const void* from, std::size_t bytes) {
  if (cuda.batch && bytes <= Cuda::kStaged)
    return copy_in_batch(cuda, "upload", to, cuda.batch->staged_copy(from, bytes), bytes);
  if (cuda.batch) cuda.batch->send();
  check_cuda(cudaMemcpyAsync(to, from, bytes, cudaMemcpyHostToDevice, cuda.stream), "upload");
  cuda.synchronize();
}
// The driver copies small data much faster into pinned memory.
inline void device_download(Cuda& cuda, void* to, const void* from, std::size_t bytes) {
  void* target = bytes <= Cuda::kStaged ? cuda.staging : to;
  if (cuda.batch && target != to) {
    copy_in_batch(cuda, "download", target, from, bytes);
  } else {
    if (cuda.batch) cuda.batch->send();
    check_cuda(cudaMemcpyAsync(target, from, bytes, cudaMemcpyDeviceToHost, cuda.stream), "download");
  }
  cuda.synchronize();
  if (target != to) std::memcpy(to, target, bytes);
}
// Allocates pinned memory of the host, which loops can write.
inline void* host_allocate(Cuda&, std::size_t bytes) {
  ++device_counts.allocations;
  void* memory = nullptr;
  check_cuda(cudaHostAlloc(&memory, bytes, cudaHostAllocDefault), "allocate on the host");
  return memory;
}
inline void host_free(Cuda& cuda, void* memory) { cuda.release(memory, cudaFreeHost); }

}  // namespace hysteron
