// Stands in for primitives_gpu.cpp in a build without CUDA.
#include "tests/sim/device/primitives.h"

namespace hysteron::test {

std::unique_ptr<Primitives> gpu_primitives() { return nullptr; }

}  // namespace hysteron::test
