#include "experiments/bench/element_costs.h"

#include <fmt/core.h>

#include <algorithm>

#include "experiments/bench/step_profile.h"
#include "sim/scene/cloth.h"

namespace hysteron::experiments {
namespace {

struct Case {
  const char* element;
  const char* law;
  const char* memory = "stops";  // of prandtl
};
constexpr Case kCases[] = {{"shape", "linear"}, {"shape", "prandtl"}, {"shape", "wong"},
                           {"hinge", "linear"}, {"hinge", "prandtl"}, {"hinge", "prandtl", "stack"},
                           {"hinge", "wong"}};
constexpr int kBatches = 7;

void take(const Case& c, Scene& scene) {
  scene.element = value_named<BendingElement>(c.element);
  scene.law = c.law;
  scene.param.clear();
  if (scene.law == "prandtl") scene.param["memory"] = c.memory;
}

int common_substeps(Scene scene, const Cloth& cloth) {
  int most = scene.substeps;
  for (const Case& c : kCases) {
    take(c, scene);
    scene.substeps = 0;
    most = std::max(most, make_simulation(scene, cloth)->limits().substeps);
  }
  return most;
}

Metrics measured_row(const Scene& scene, const Cloth& cloth, int steps) {
  const auto simulation = make_simulation(scene, cloth);
  const int triangles = cloth.mesh.faces();
  simulation->advance(steps);  // warm caches, and away from the flat start
  const auto before = simulation->stage_seconds();
  const StepCost cost = cost_of_steps(*simulation, kBatches, steps);
  const auto after = simulation->stage_seconds();
  const std::string hash = fmt::format("{:016x}", simulation->state_hash());
  Metrics row = {{"scene", "hanging-square"},           {"triangles", triangles},
                 {"device", simulation->device()},      {"precision", enum_name(scene.precision)},
                 {"element", enum_name(scene.element)}, {"law", scene.law}};
  if (scene.law == "prandtl") row.set("memory", scene.param.at("memory"));
  row.set("integrator", enum_name(scene.integrator));
  row.set("substeps", simulation->limits().substeps);
  row.set("solver_iterations", cost.solver_iterations);
  row.set("ms_per_step", cost.ms);
  row.set("ms_per_step_fastest", cost.ms_fastest);
  for (std::size_t s = 0; s < after.size(); ++s)
    row.set("ms_" + after[s].first, 1e3 * (after[s].second - before[s].second) / (kBatches * steps));
  const double bytes = stated_bytes(loops_of_steps(*simulation, steps)) / steps;
  row.set("bytes_device", simulation->counts().bytes);
  row.set("bytes_per_triangle", static_cast<double>(simulation->counts().bytes) / triangles);
  row.set("bytes_per_step", bytes);
  row.set("fraction_of_copy_bandwidth", bytes / (1e-3 * cost.ms) / simulation->copy_bandwidth());
  row.set("state_hash", hash);
  return row;
}

}  // namespace

std::vector<Metrics> element_costs(const Scene& requested, int steps,
                                   const std::function<void(const Metrics&)>& measured) {
  const Cloth cloth = make_cloth(requested);
  Scene scene = requested;
  scene.substeps = common_substeps(scene, cloth);
  std::vector<Metrics> rows;
  for (const Case& c : kCases) {
    take(c, scene);
    rows.push_back(measured_row(scene, cloth, steps));
    measured(rows.back());
  }
  return rows;
}

}  // namespace hysteron::experiments
