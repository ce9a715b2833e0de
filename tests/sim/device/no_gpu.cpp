// Stands in for on_gpu.cpp in a build without CUDA.
#include "tests/sim/device/linear_solves.h"
#include "tests/sim/device/primitives.h"

namespace hysteron::test {

std::unique_ptr<LinearSolves> gpu_linear_solves() { return nullptr; }

std::unique_ptr<Primitives> gpu_primitives() { return nullptr; }

}  // namespace hysteron::test
