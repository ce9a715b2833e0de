#include "tests/sim/device/linear_solves_on.h"
#include "tests/sim/device/primitives_on.h"

namespace hysteron::test {

std::unique_ptr<LinearSolves> cpu_linear_solves() { return std::make_unique<LinearSolvesOn<Cpu>>(1); }

std::unique_ptr<Primitives> cpu_primitives(int threads) {
  return std::make_unique<PrimitivesOn<Cpu>>(threads);
}

}  // namespace hysteron::test
