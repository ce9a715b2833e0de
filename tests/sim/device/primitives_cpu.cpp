#include "tests/sim/device/primitives_on.h"

namespace hysteron::test {

std::unique_ptr<Primitives> cpu_primitives(int threads) {
  return std::make_unique<PrimitivesOn<Cpu>>(threads);
}

}  // namespace hysteron::test
