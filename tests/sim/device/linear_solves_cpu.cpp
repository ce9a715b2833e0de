#include "tests/sim/device/linear_solves_on.h"

namespace hysteron::test {

std::unique_ptr<LinearSolves> cpu_linear_solves() { return std::make_unique<LinearSolvesOn<Cpu>>(1); }

}  // namespace hysteron::test
