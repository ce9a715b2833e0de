#include "sim/device/cpu.h"

#include <omp.h>

namespace hysteron {

Cpu::Cpu(int thread_count) : threads(thread_count > 0 ? thread_count : omp_get_num_procs()) {}

std::string Cpu::description() const { return "CPU, " + std::to_string(threads) + " threads"; }

}  // namespace hysteron
