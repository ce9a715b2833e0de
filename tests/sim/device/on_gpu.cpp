// Compiled by nvcc only.
#include "tests/sim/device/linear_solves_on.h"
#include "tests/sim/device/primitives_on.h"

namespace hysteron::test {

std::unique_ptr<LinearSolves> gpu_linear_solves() { return std::make_unique<LinearSolvesOn<Cuda>>(0); }

std::unique_ptr<Primitives> gpu_primitives() { return std::make_unique<PrimitivesOn<Cuda>>(0); }

}  // namespace hysteron::test
