// Opens an OpenGL buffer for a device's positions, as far as the device can write one.
#pragma once

#include <memory>
#include <string>

#include "sim/device/device.h"
#include "sim/device/gl_positions.h"
#ifdef __CUDACC__
#include "sim/device/cuda_gl_buffer.h"
#endif

namespace hysteron {

template <class Real>
std::unique_ptr<GlPositions> share_positions(Cpu&, const Buffer<Vec3<Real>, Cpu>&, unsigned /*gl_buffer*/,
                                             int /*gl_device*/, std::string& reason) {
  reason = "the simulation runs on the CPU";
  return nullptr;
}

#ifdef __CUDACC__
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
  CudaGlPositions(Cuda& cuda, const Buffer<Vec3<Real>, Cuda>& x, unsigned gl_buffer, std::string& reason)
      : cuda_(cuda), x_(x), buffer_(cuda, gl_buffer, reason) {}

  bool is_open() const { return buffer_.is_open(); }

  bool write(std::string& reason) override {
    float* xyz = buffer_.map(cuda_, 3 * x_.size(), reason);
    if (!xyz) return false;
    bool launched = true;
    try {
      write_floats(cuda_, x_, xyz);
    } catch (const Error& error) {
      reason = error.what();
      launched = false;
    }
    return buffer_.unmap(cuda_, reason) && launched;
  }

 private:
  Cuda& cuda_;
  const Buffer<Vec3<Real>, Cuda>& x_;
  CudaGlBuffer buffer_;
};

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
#endif

}  // namespace hysteron
