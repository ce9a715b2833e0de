// Replaces gpu_back_end.cpp in a build without CUDA.
#include "sim/base/error.h"
#include "sim/device/visible_gpus.h"
#include "sim/time/back_end.h"

namespace hysteron {

namespace {

[[noreturn]] void refuse() {
  std::string reason;
  gpu_count(reason);
  throw Error::system("device = cuda: " + reason);
}

}  // namespace

std::unique_ptr<Simulation> make_gpu_simulation(const Scene&, const Cloth&, const CurvatureOperator&,
                                                const StepLimits&) {
  refuse();
}

void run_on_gpu_together(int, const std::function<void(int)>&) { refuse(); }

bool is_built_with_cuda() { return false; }

int gpu_count(std::string& reason) {
  reason = "this program was built without CUDA";
  return 0;
}

std::string gpu_description(int) { return "cuda: none"; }

}  // namespace hysteron
