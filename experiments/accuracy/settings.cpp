#include "experiments/accuracy/accuracy.h"

#include <cmath>

namespace hysteron::experiments {

Scene with(const Setting& setting, Scene scene) {
  scene.mesh = setting.mesh;
  scene.element = setting.element;
  scene.law = setting.law;
  scene.integrator = setting.integrator;
  scene.implicit_every = setting.implicit_every;
  scene.precision = setting.precision;
  scene.device = setting.device;
  scene.threads = 1;
  scene.substeps = 0;
  if (setting.triangles > 0) scene.triangles = setting.triangles;
  if (setting.step > 0) scene.step = setting.step;
  (setting.integrator == Integrator::quasi_static ? scene.newton_residual : scene.tolerance) =
      setting.tolerance;
  if (scene.newton_residual == 0) scene.newton_residual = Scene{}.newton_residual;
  return scene;
}

void note_cost(Simulation& simulation, const Scene& scene, std::chrono::steady_clock::time_point start,
               Found& found) {
  found.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  const long parts = simulation.parts_taken();
  found.steps = parts > 0             ? parts
                : scene.is_implicit() ? simulation.steps()
                                      : simulation.steps() * simulation.limits().substeps;
  found.bytes = simulation.device_bytes();
}

}  // namespace hysteron::experiments
