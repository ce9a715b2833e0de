// Compiled by nvcc only.
#include "tests/sim/device/primitives_on.h"

namespace hysteron::test {

std::unique_ptr<Primitives> gpu_primitives() { return std::make_unique<PrimitivesOn<Cuda>>(0); }

}  // namespace hysteron::test
