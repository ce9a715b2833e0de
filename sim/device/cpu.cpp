#include "sim/device/cpu.h"

#include <omp.h>

namespace hysteron {

Cpu::Cpu(int thread_count) : threads(thread_count > 0 ? thread_count : omp_get_max_threads()) {}

void KernelProfile<Cpu>::end(const Kernel& kernel) {
  KernelCost& cost = costs_[kernel.name];
  cost.seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  ++cost.calls;
  cost.bytes += static_cast<double>(kernel.bytes);
}

std::string Cpu::description() const { return "CPU, " + std::to_string(threads) + " threads"; }

}  // namespace hysteron
