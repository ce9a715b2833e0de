#include "experiments/bench/parts.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "sim/base/error.h"
#include "sim/time/simulation.h"

namespace hysteron::experiments {
namespace {

Metrics stopped(const HardScene& of, const std::string& without, const std::string& why) {
  return {{"scene", of.name},
          {"without", without},
          {"triangles", of.cloth.mesh.faces()},
          {"device", ""},
          {"bytes_per_triangle", NAN},
          {"launches_per_step", NAN},
          {"synchronizations_per_step", NAN},
          {"newton_iterations_per_step", NAN},
          {"solver_iterations_per_step", NAN},
          {"ms_per_step", NAN},
          {"stopped", why}};
}

Metrics timed(const HardScene& of, const Scene& scene, const std::string& without, double after, int steps) {
  const auto simulation = make_simulation(scene, of.cloth);
  simulation->advance(std::max(1, static_cast<int>(std::lround(after / scene.step))));
  const DeviceCounts work_before = simulation->device_work();
  const SolverCounts solved_before = simulation->solver_counts();
  simulation->wait();
  const auto start = std::chrono::steady_clock::now();
  simulation->advance(steps);
  simulation->wait();
  const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
  const DeviceCounts work = simulation->device_work() - work_before;
  const SolverCounts solved = simulation->solver_counts();
  const auto per_step = [&](long count) { return static_cast<double>(count) / steps; };
  return {{"scene", of.name},
          {"without", without},
          {"triangles", of.cloth.mesh.faces()},
          {"device", simulation->device()},
          {"bytes_per_triangle", static_cast<double>(simulation->device_bytes()) / of.cloth.mesh.faces()},
          {"launches_per_step", per_step(work.loops)},
          {"synchronizations_per_step", per_step(work.synchronizations)},
          {"newton_iterations_per_step", per_step(solved.newton - solved_before.newton)},
          {"solver_iterations_per_step", per_step(solved.linear - solved_before.linear)},
          {"ms_per_step", 1e3 * taken.count() / steps},
          {"stopped", ""}};
}

Metrics row_of(const HardScene& of, const Scene& scene, const std::string& without, double after, int steps) {
  try {
    return timed(of, scene, without, after, steps);
  } catch (const Error& error) {
    if (error.exit_code() != 3) throw;  // not of the run, but of the machine or the request
    return stopped(of, without, error.what());
  }
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
