// Numerical code includes this file: for_each, for_each_sum, Buffer, and the device of this compilation.
//
// Every numerical source of sim/ is compiled twice when CUDA is built: by the C++ compiler for the CPU and by
// nvcc for the GPU.  It ends with instantiations that name ThisDevice.
#pragma once

#include "sim/device/buffer.h"

namespace hysteron {

#ifdef __CUDACC__
using ThisDevice = Cuda;
#else
using ThisDevice = Cpu;
#endif

// Returns the position of element i's slot k in an array of n elements with `slots` numbers each.  The slots
// are consecutive on the CPU, so that one element's history is one cache line run and vectorises, and strided
// on the GPU, so that neighbouring threads read neighbours.
HYST_HD inline std::size_t slot_index(int i, int k, int slots, int n) {
#ifdef __CUDA_ARCH__
  return static_cast<std::size_t>(k) * n + i;
#else
  (void)n;
  return static_cast<std::size_t>(i) * slots + k;
#endif
}

}  // namespace hysteron
