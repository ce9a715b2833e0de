// Compiled by nvcc only.  The runtime's interop calls find the driver's OpenGL themselves: none is linked.
#include "sim/device/cuda_gl_buffer.h"

#include <cuda_gl_interop.h>

namespace hysteron {
namespace {

bool succeeds(cudaError_t status, const char* name, std::string& reason) {
  if (status == cudaSuccess) return true;
  cudaGetLastError();  // what is reported here must not be found by the next launch
  reason = std::string("CUDA cannot ") + name + ": " + cudaGetErrorString(status);
  return false;
}

}  // namespace

CudaGlBuffer::CudaGlBuffer(Cuda& cuda, unsigned name, std::string& reason) {
  // Each thread has a device of its own, and this one may be the renderer's.
  if (!succeeds(cudaSetDevice(cuda.index), "select the device", reason)) return;
  if (!succeeds(cudaGraphicsGLRegisterBuffer(&resource_, name, cudaGraphicsRegisterFlagsWriteDiscard),
                "register the OpenGL buffer", reason))
    resource_ = nullptr;
}

CudaGlBuffer::~CudaGlBuffer() {
  std::string nobody_to_tell;
  if (resource_) succeeds(cudaGraphicsUnregisterResource(resource_), "unregister", nobody_to_tell);
}

float* CudaGlBuffer::map(Cuda& cuda, std::size_t floats, std::string& reason) {
  if (!succeeds(cudaGraphicsMapResources(1, &resource_, cuda.stream), "map the OpenGL buffer", reason))
    return nullptr;
  void* memory = nullptr;
  std::size_t bytes = 0;
  if (succeeds(cudaGraphicsResourceGetMappedPointer(&memory, &bytes, resource_), "find the OpenGL buffer",
               reason)) {
    if (bytes >= floats * sizeof(float)) return static_cast<float*>(memory);
    reason = "the OpenGL buffer has " + std::to_string(bytes) + " bytes, " +
             std::to_string(floats * sizeof(float)) + " are needed";
  }
  std::string first_reason_counts;
  unmap(cuda, first_reason_counts);
  return nullptr;
}

bool CudaGlBuffer::unmap(Cuda& cuda, std::string& reason) {
  return succeeds(cudaGraphicsUnmapResources(1, &resource_, cuda.stream), "unmap the OpenGL buffer", reason);
}

}  // namespace hysteron
