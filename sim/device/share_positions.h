// Opens an OpenGL buffer for a device's positions, if the device can write one.
#pragma once

#include <memory>
#include <string>

#include "sim/device/device.h"
#include "sim/device/gl_positions.h"

namespace hysteron {

template <class Real>
std::unique_ptr<GlPositions> share_positions(Cpu&, const Buffer<Vec3<Real>, Cpu>&, unsigned /*gl_buffer*/,
                                             int /*gl_device*/, std::string& reason) {
  reason = "the simulation runs on the CPU";
  return nullptr;
}

#ifdef __CUDACC__
template <class Real>  // defined in cuda_gl_positions.cpp
std::unique_ptr<GlPositions> share_positions(Cuda& cuda, const Buffer<Vec3<Real>, Cuda>& x,
                                             unsigned gl_buffer, int gl_device, std::string& reason);
#endif

}  // namespace hysteron
