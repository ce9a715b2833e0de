#include "experiments/fold/material.h"

#include <cmath>

#include "experiments/specimens/cantilever_strip.h"
#include "sim/reference/kes.h"

namespace hysteron::experiments {
namespace {

constexpr int kTestSteps = 100;  // steps of each part of a KES cycle
// Steps of each half cycle.  Fatigue acts from step to step: with this many, M0 errs by less than 0.1 %.
constexpr int kSteps = 50;

// Bends in equal steps and returns the state after the last.
LawPoint bend(LawWalk& walk, double from, double to, int steps, double seconds) {
  LawPoint end;
  for (int i = 1; i <= steps; ++i) end = walk.to({from + (to - from) * i / steps, seconds / steps});
  return end;
}

// Returns the law along the strip, whatever the angle of its warp.
LawRequest scene_law(const Scene& scene) { return {scene.law, curve_along(scene), scene.param}; }

}  // namespace

MaterialReading test_material(const LawWalk& material, double curvature) {
  const KesProtocol kes;
  LawWalk walk = material;
  double at = curvature;
  const auto go = [&](double to) {
    const double moment = bend(walk, at, to, kTestSteps, std::abs(to - at) / kes.rate).moment;
    at = to;
    return moment;
  };
  go(kes.amplitude);
  const double high = go(kes.width_at), low = go(-kes.width_at);
  go(-kes.amplitude);
  const double low_back = go(-kes.width_at), high_back = go(kes.width_at);
  MaterialReading reading;
  reading.loop_width = (high_back - high + low_back - low) / 2;
  // These are read before the test, which wears the material; without fatigue the test changes nothing.
  reading.permanent_set = material.permanent_set();
  const double friction = material.friction_moment();
  reading.friction = std::isnan(friction) ? reading.loop_width / 2 : friction;
  return reading;
}

LawRequest law_in_cloth(const Scene& scene) {
  LawRequest law = scene_law(scene);
  if (law.name == "prandtl") law.parameters.try_emplace("memory", "stops");
  return law;
}

std::vector<BendingCycle> bend_repeatedly(const Scene& scene, const FoldParams& choice) {
  LawRequest law = scene_law(scene);
  // This memory is exact: between two reversals no more of them are remembered.
  if (law.name == "prandtl" && !law.parameters.contains("memory")) law.parameters.try_emplace("stack", "8");
  LawWalk walk(law);
  std::vector<BendingCycle> cycles;
  double before = 0;
  for (int n = 1; n <= choice.cycles; ++n) {
    const double leg = choice.period / 2;
    bend(walk, 0, choice.curvature, kSteps, leg);
    const double total = bend(walk, choice.curvature, 0, kSteps, leg).dissipated;
    if (is_chosen(n, choice.cycles))
      cycles.push_back({n, test_material(walk, 0), walk.residual(), total - before, total});
    before = total;
  }
  return cycles;
}

}  // namespace hysteron::experiments
