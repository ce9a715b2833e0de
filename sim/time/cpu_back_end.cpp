#include <algorithm>

#include "sim/bending/law_loop.h"
#include "sim/time/back_end.h"
#include "sim/time/stepper.h"

namespace hysteron {

std::unique_ptr<Simulation> make_cpu_simulation(const Scene& scene, const Cloth& cloth,
                                                const CurvatureOperator& op, const StepLimits& limits) {
  auto cpu = std::make_unique<Cpu>(scene.threads);
  if (scene.precision == Precision::fp32)
    return std::make_unique<Stepper<float, Cpu>>(std::move(cpu), scene, cloth, op, limits);
  return std::make_unique<Stepper<double, Cpu>>(std::move(cpu), scene, cloth, op, limits);
}

double law_largest_stiffness(const Scene& scene, const CurvatureOperator& op) {
  Cpu cpu(1);
  const double beside = op.elastic.empty() ? 0 : *std::max_element(op.elastic.begin(), op.elastic.end());
  return make_law_loop<double>(cpu, choose_law(scene.law, scene.fabric.virgin_curve(), scene.param),
                               op.dimension, 0)
             ->largest_stiffness() +
         std::max(0.0, beside);
}

std::string cpu_description() { return "cpu: " + Cpu(0).description(); }

}  // namespace hysteron
