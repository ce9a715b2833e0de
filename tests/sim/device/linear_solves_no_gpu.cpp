// Stands in for linear_solves_gpu.cpp in a build without CUDA.
#include "tests/sim/device/linear_solves.h"

namespace hysteron::test {

std::unique_ptr<LinearSolves> gpu_linear_solves() { return nullptr; }

}  // namespace hysteron::test
