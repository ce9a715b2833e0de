// An OpenGL buffer that CUDA kernels write.  Included under nvcc only.
#pragma once

#include <cstddef>
#include <string>

#include "sim/device/cuda.h"

namespace hysteron {

// Refusals are no errors here: there is another way for what would be written.  They leave no CUDA error
// behind for the next launch to find.
class CudaGlBuffer {
 public:
  // Registers the buffer for kernels of `cuda` that this thread launches; is_open() tells whether the driver
  // agreed, `reason` why not.
  CudaGlBuffer(Cuda& cuda, unsigned name, std::string& reason);
  ~CudaGlBuffer();
  CudaGlBuffer(const CudaGlBuffer&) = delete;
  CudaGlBuffer& operator=(const CudaGlBuffer&) = delete;

  bool is_open() const { return resource_ != nullptr; }

  // The buffer's memory for kernels of cuda.stream, after all GL calls made so far; its content is undefined
  // until written.  Null, and why, if the driver refuses or the buffer holds fewer floats.
  float* map(Cuda& cuda, std::size_t floats, std::string& reason);
  // Gives the buffer back to OpenGL: later GL calls wait for the kernels.
  bool unmap(Cuda& cuda, std::string& reason);

 private:
  cudaGraphicsResource* resource_ = nullptr;
};

}  // namespace hysteron
