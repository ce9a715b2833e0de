#include "experiments/bench/parts.h"

#include <algorithm>
#include <cmath>

#include "experiments/bench/step_profile.h"
#include "sim/base/error.h"
#include "sim/time/simulation.h"

namespace hysteron::experiments {
namespace {

// What a step takes; not known of a scene that stops.
void measure(Metrics& row, const HardScene& of, const Scene& scene, double after, int steps) {
  const auto simulation = make_simulation(scene, of.cloth);
  simulation->advance(std::max(1, static_cast<int>(std::lround(after / scene.step))));
  const DeviceCounts work_before = simulation->device_work();
  const SolverCounts solved_before = simulation->solver_counts();
  const double ms = ms_per_step(*simulation, steps);
  const DeviceCounts work = simulation->device_work() - work_before;
  const SolverCounts solved = simulation->solver_counts();
  const auto per_step = [&](long count) { return static_cast<double>(count) / steps; };
  row.set("device", simulation->device());
  row.set("bytes_per_triangle", static_cast<double>(simulation->device_bytes()) / of.cloth.mesh.faces());
  row.set("launches_per_step", per_step(work.loops));
  row.set("synchronizations_per_step", per_step(work.synchronizations));
  row.set("newton_iterations_per_step", per_step(solved.newton - solved_before.newton));
  row.set("solver_iterations_per_step", per_step(solved.linear - solved_before.linear));
  row.set("ms_per_step", ms);
}

Metrics row_of(const HardScene& of, const Scene& scene, const std::string& without, double after, int steps) {
  Metrics row = {
      {"scene", of.name}, {"without", without}, {"triangles", of.cloth.mesh.faces()}, {"device", ""}};
  for (const char* unknown : {"bytes_per_triangle", "launches_per_step", "synchronizations_per_step",
                              "newton_iterations_per_step", "solver_iterations_per_step", "ms_per_step"})
    row.set(unknown, NAN);
  row.set("stopped", "");
  try {
    measure(row, of, scene, after, steps);
  } catch (const Error& error) {
    if (error.exit_code() != 3) throw;  // not of the run, but of the machine or the request
    row.set("stopped", error.what());
  }
  return row;
}

}  // namespace

std::vector<Omission> omissions() {
  return {
      {"self-contact", [](const Scene& s) { return s.self_contact; },
       [](Scene& s) { s.self_contact = false; }},
      {"obstacles", [](const Scene& s) { return !s.obstacle.empty(); }, [](Scene& s) { s.obstacle.clear(); }},
      {"friction of contact",
       [](const Scene& s) { return s.fabric.friction > 0 && (s.self_contact || !s.obstacle.empty()); },
       [](Scene& s) { s.fabric.friction = 0; }},
      {"hysteresis", [](const Scene& s) { return s.law != "linear"; },
       [](Scene& s) {
         s.law = "linear";
         s.param.clear();
       }},
      {"fatigue", [](const Scene& s) { return s.param.contains("fatigue.dc"); },
       [](Scene& s) {
         std::erase_if(s.param, [](const auto& p) { return p.first.starts_with("fatigue."); });
       }},
      {"damping of bending", [](const Scene& s) { return s.fabric.damping > 0; },
       [](Scene& s) { s.fabric.damping = 0; }},
      {"drag of the air", [](const Scene& s) { return s.air_drag > 0; }, [](Scene& s) { s.air_drag = 0; }}};
}

std::vector<Metrics> cost_of_parts(const HardScene& of, double after, int steps) {
  std::vector<Metrics> rows = {row_of(of, of.scene, "", after, steps)};
  for (const Omission& omission : omissions()) {
    if (!omission.is_there(of.scene)) continue;
    Scene scene = of.scene;
    omission.leave_out(scene);
    rows.push_back(row_of(of, scene, omission.part, after, steps));
  }
  return rows;
}

}  // namespace hysteron::experiments
