// Only nvcc compiles this file.  The runtime's interop calls find the driver's OpenGL themselves: none is
// linked.
#include <cuda_gl_interop.h>

#include "sim/device/share_positions.h"

namespace hysteron {
namespace {

// Reports whether a call succeeds.  Refusals are no errors here: positions can be written another way.  They
// leave no CUDA error behind for the next launch to find.
bool succeeds(cudaError_t status, const char* name, std::string& reason) {
  if (status == cudaSuccess) return true;
  cudaGetLastError();
  reason = std::string("CUDA cannot ") + name + ": " + cudaGetErrorString(status);
  return false;
}

template <class Real>
void write_floats(Cuda& cuda, const Buffer<Vec3<Real>, Cuda>& from, float* to) {
  const Vec3<Real>* x = from.data();
  for_each(
      cuda, "positions to OpenGL", static_cast<int>(from.size()), HYST_KERNEL(int i) {
        for (int k = 0; k < 3; ++k) to[3 * i + k] = static_cast<float>(x[i][k]);
      });
}

template <class Real>
class CudaGlPositions : public GlPositions {
 public:
  // Registers the buffer for kernels of `cuda` that this thread launches; is_open() returns whether the
  // driver agreed, `reason` says why not.
  CudaGlPositions(Cuda& cuda, const Buffer<Vec3<Real>, Cuda>& x, unsigned gl_buffer, std::string& reason)
      : cuda_(cuda), x_(x) {
    // Each thread has a current device of its own, and this one may be the renderer's.
    if (!succeeds(cudaSetDevice(cuda.index), "select the device", reason)) return;
    if (!succeeds(cudaGraphicsGLRegisterBuffer(&resource_, gl_buffer, cudaGraphicsRegisterFlagsWriteDiscard),
                  "register the OpenGL buffer", reason))
      resource_ = nullptr;
  }
  ~CudaGlPositions() override {
    std::string nobody_to_tell;
    if (resource_) succeeds(cudaGraphicsUnregisterResource(resource_), "unregister", nobody_to_tell);
  }

  bool is_open() const { return resource_ != nullptr; }

  bool write(std::string& reason) override {
    float* xyz = map(reason);
    if (!xyz) return false;
    bool launched = true;
    try {
      write_floats(cuda_, x_, xyz);
    } catch (const Error& error) {
      reason = error.what();
      launched = false;
    }
    return unmap(reason) && launched;
  }

 private:
  // Returns the buffer's memory for kernels of cuda_.stream, after all GL calls made so far; its content is
  // undefined until written.  Returns null, and sets `reason`, if the driver refuses or the buffer holds
  // fewer floats.
  float* map(std::string& reason) {
    if (!succeeds(cudaGraphicsMapResources(1, &resource_, cuda_.stream), "map the OpenGL buffer", reason))
      return nullptr;
    const std::size_t needed = 3 * x_.size() * sizeof(float);
    void* memory = nullptr;
    std::size_t bytes = 0;
    if (succeeds(cudaGraphicsResourceGetMappedPointer(&memory, &bytes, resource_), "find the OpenGL buffer",
                 reason)) {
      if (bytes >= needed) return static_cast<float*>(memory);
      reason = "the OpenGL buffer has " + std::to_string(bytes) + " bytes, " + std::to_string(needed) +
               " are needed";
    }
    std::string first_reason_counts;
    unmap(first_reason_counts);
    return nullptr;
  }
  // Gives the buffer back to OpenGL: later GL calls wait for the kernels.
  bool unmap(std::string& reason) {
    return succeeds(cudaGraphicsUnmapResources(1, &resource_, cuda_.stream), "unmap the OpenGL buffer",
                    reason);
  }

  Cuda& cuda_;
  const Buffer<Vec3<Real>, Cuda>& x_;
  cudaGraphicsResource* resource_ = nullptr;
};

}  // namespace

template <class Real>
std::unique_ptr<GlPositions> share_positions(Cuda& cuda, const Buffer<Vec3<Real>, Cuda>& x,
                                             unsigned gl_buffer, int gl_device, std::string& reason) {
  if (cuda.batch) {
    reason = "the simulation is one of a batch";
    return nullptr;
  }
  if (gl_device != cuda.index) {
    reason = "OpenGL does not draw on CUDA device " + std::to_string(cuda.index);
    return nullptr;
  }
  auto positions = std::make_unique<CudaGlPositions<Real>>(cuda, x, gl_buffer, reason);
  if (!positions->is_open()) return nullptr;
  return positions;
}

template std::unique_ptr<GlPositions> share_positions(Cuda&, const Buffer<Vec3<double>, Cuda>&, unsigned, int,
                                                      std::string&);
template std::unique_ptr<GlPositions> share_positions(Cuda&, const Buffer<Vec3<float>, Cuda>&, unsigned, int,
                                                      std::string&);

}  // namespace hysteron
