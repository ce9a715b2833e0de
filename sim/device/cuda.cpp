// Only nvcc compiles this file.
#include "sim/device/cuda.h"

#include <cstdlib>

#if __has_include(<nvtx3/nvToolsExt.h>)
#include <nvtx3/nvToolsExt.h>
#define HYST_NVTX(call) call
#else
#define HYST_NVTX(call)
#endif

namespace hysteron {

namespace {

constexpr std::size_t kPending = 4096;  // profiled launches before the host has to read them

bool may_use_graphs() {
  const char* requested = std::getenv("HYSTERON_CUDA_GRAPHS");
  return !requested || std::string(requested) != "0";
}

}  // namespace

Cuda::Cuda(int device) : index(device), batch(CudaBatch::current()), graphs(may_use_graphs()) {
  check_cuda(cudaSetDevice(index), "select device");
  int major = 0;
  check_cuda(cudaDeviceGetAttribute(&major, cudaDevAttrComputeCapabilityMajor, index), "compute capability");
  early_blocks = major >= 9;
  if (batch)
    stream = batch->stream();
  else
    check_cuda(cudaStreamCreateWithFlags(&stream, cudaStreamNonBlocking), "create stream");
  check_cuda(cudaMalloc(&arrived, 2 * sizeof(unsigned)), "allocate");
  check_cuda(cudaMemset(arrived, 0, 2 * sizeof(unsigned)), "allocate");
  check_cuda(cudaHostAlloc(&staging, kStaged, cudaHostAllocDefault), "allocate on the host");
}

Cuda::~Cuda() {
  release(partial, cudaFree);
  release(arrived, cudaFree);
  release(staging, cudaFreeHost);
  if (!batch) cudaStreamDestroy(stream);
}

void Cuda::reserve_partial(int numbers, const char* name) {
  if (partial_size >= numbers) return;
  ++device_counts.allocations;
  if (partial) release(partial, cudaFree);
  check_cuda(cudaMalloc(&partial, sizeof(double) * numbers), name);
  partial_size = numbers;
}

std::string Cuda::description() const {
  cudaDeviceProp properties{};
  check_cuda(cudaGetDeviceProperties(&properties, index), "describe device");
  return std::string(properties.name);
}

KernelProfile<Cuda>::KernelProfile(Cuda& cuda) : cuda_(cuda) { pending_.reserve(kPending); }

KernelProfile<Cuda>::~KernelProfile() {
  for (cudaEvent_t event : event_) cudaEventDestroy(event);
}

void KernelProfile<Cuda>::begin(const Kernel& kernel) {
  if (pending_.size() == kPending) collect();
  while (event_.size() < 2 * (pending_.size() + 1)) {
    event_.emplace_back();
    check_cuda(cudaEventCreate(&event_.back()), "profile");
  }
  HYST_NVTX(nvtxRangePushA(kernel.name));
  check_cuda(cudaEventRecord(event_[2 * pending_.size()], cuda_.stream), kernel.name);
}

// Failures here are found by collect().
void KernelProfile<Cuda>::end(const Kernel& kernel) {
  cudaEventRecord(event_[2 * pending_.size() + 1], cuda_.stream);
  HYST_NVTX(nvtxRangePop());
  pending_.push_back(kernel);
}

// This waits, too, but not on behalf of the step: device_counts does not count it.
void KernelProfile<Cuda>::collect() {
  check_cuda(cudaStreamSynchronize(cuda_.stream), "profile");
  for (std::size_t i = 0; i < pending_.size(); ++i) {
    float milliseconds = 0;
    check_cuda(cudaEventElapsedTime(&milliseconds, event_[2 * i], event_[2 * i + 1]), pending_[i].name);
    KernelCost& cost = costs_[pending_[i].name];
    ++cost.calls;
    cost.seconds += 1e-3 * milliseconds;
    cost.bytes += static_cast<double>(pending_[i].bytes);
  }
  pending_.clear();
}

KernelCosts KernelProfile<Cuda>::costs() {
  collect();
  return costs_;
}

int cuda_device_count(std::string& reason) {
  int count = 0;
  const cudaError_t status = cudaGetDeviceCount(&count);
  if (status == cudaSuccess && count > 0) return count;
  reason = status == cudaSuccess ? "no CUDA device" : cudaGetErrorString(status);
  return 0;
}

}  // namespace hysteron
