// Compiled by nvcc only.
#include "sim/device/cuda.h"

namespace hysteron {

Cuda::Cuda(int device) : index(device) {
  check_cuda(cudaSetDevice(index), "select device");
  check_cuda(cudaStreamCreateWithFlags(&stream, cudaStreamNonBlocking), "create stream");
  check_cuda(cudaMalloc(&arrived, sizeof(unsigned)), "allocate");
  check_cuda(cudaMemset(arrived, 0, sizeof(unsigned)), "allocate");
}

Cuda::~Cuda() {
  cudaFree(partial);
  cudaFree(arrived);
  cudaStreamDestroy(stream);
}

std::string Cuda::description() const {
  cudaDeviceProp properties{};
  check_cuda(cudaGetDeviceProperties(&properties, index), "describe device");
  return std::string(properties.name);
}

int cuda_device_count(std::string& reason) {
  int count = 0;
  const cudaError_t status = cudaGetDeviceCount(&count);
  if (status == cudaSuccess && count > 0) return count;
  reason = status == cudaSuccess ? "no CUDA device" : cudaGetErrorString(status);
  return 0;
}

}  // namespace hysteron
