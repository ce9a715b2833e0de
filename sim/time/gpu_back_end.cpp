// Only nvcc compiles this file.
#include "sim/device/visible_gpus.h"
#include "sim/time/back_end.h"
#include "sim/time/stepper.h"

namespace hysteron {

std::unique_ptr<Simulation> make_gpu_simulation(const Scene& scene, const Cloth& cloth,
                                                const CurvatureOperator& op, const StepLimits& limits) {
  auto gpu = std::make_unique<Cuda>(0);
  if (scene.precision == Precision::fp32)
    return std::make_unique<Stepper<float, Cuda>>(std::move(gpu), scene, cloth, op, limits);
  return std::make_unique<Stepper<double, Cuda>>(std::move(gpu), scene, cloth, op, limits);
}

void run_on_gpu_together(int count, const std::function<void(int)>& job) { CudaBatch(0, count).run(job); }

bool is_built_with_cuda() { return true; }

int gpu_count(std::string& reason) { return cuda_device_count(reason); }

std::string gpu_description(int index) { return "cuda: " + Cuda(index).description(); }

}  // namespace hysteron
