#include "experiments/bench/parts.h"

#include <algorithm>
#include <cmath>

#include "experiments/bench/step_profile.h"
#include "sim/base/error.h"
#include "sim/time/simulation.h"

namespace hysteron::experiments {
namespace {

constexpr const char* kLedgerLoops[] = {"implicit ledger", "viscous loss"};

class PartsOfScene {
 public:
  PartsOfScene(const HardScene& of, const PartsChoice& choice, const Budget& budget)
      : of_(of), choice_(choice), budget_(budget) {}

  Metrics as_it_is() {
    const Stopwatch clock;
    Metrics row = row_of(of_.scene, "", [&](Simulation& simulation) { look_for_ledger(simulation); });
    seconds_ = clock.seconds();
    whole_ = row;
    return row;
  }

  Metrics without(const Omission& omission) {
    Scene scene = of_.scene;
    omission.leave_out(scene);
    return row_of(scene, omission.part, {});
  }

  Metrics without_ledger() const {
    Metrics row = whole_;
    row.set("without", "energy ledger");
    const auto less = [&](const char* key, double by) { row.set(key, row.number(key) - by); };
    less("bytes_per_triangle", ledger_bytes_ / of_.cloth.mesh.faces());
    less("launches_per_step", ledger_launches_);
    less("ms_per_step", ledger_ms_);
    for (const char* key : {"ms_per_step_fastest", "ms_per_step_slowest"}) row.set(key, NAN);
    return row;
  }

 private:
  Metrics row_of(const Scene& scene, const std::string& without,
                 const std::function<void(Simulation&)>& afterwards) {
    Metrics row = {{"scene", of_.name},
                   {"without", without},
                   {"triangles", of_.cloth.mesh.faces()},
                   {"device", ""},
                   {"bytes_per_triangle", NAN}};
    set(row, StepCost{});
    row.set("stopped", budget_.refusal(seconds_));
    if (!row["stopped"].text().empty()) return row;
    try {
      measure(scene, row, afterwards);
    } catch (const Error& error) {
      if (error.exit_code() != 3) throw;  // not of the run, but of the machine or the request
      row.set("stopped", error.what());
    }
    return row;
  }

  void measure(const Scene& scene, Metrics& row, const std::function<void(Simulation&)>& afterwards) {
    const auto simulation = make_simulation(scene, of_.cloth);
    simulation->advance(std::max(1, static_cast<int>(std::lround(choice_.after / scene.step))));
    set(row, cost_of_steps(*simulation, choice_.steps, 1));
    row.set("device", simulation->device());
    row.set("bytes_per_triangle", static_cast<double>(simulation->device_bytes()) / of_.cloth.mesh.faces());
    if (afterwards) afterwards(*simulation);
  }

  void look_for_ledger(Simulation& simulation) {
    for (const ScenePart& part : simulation.parts())
      if (part.name == "energy ledger") ledger_bytes_ = static_cast<double>(part.bytes);
    const KernelCosts costs = loops_of_steps(simulation, choice_.steps);
    for (const char* loop : kLedgerLoops) {
      const auto found = costs.find(loop);
      if (found == costs.end()) continue;
      ledger_launches_ += static_cast<double>(found->second.calls) / choice_.steps;
      ledger_ms_ += 1e3 * found->second.seconds / choice_.steps;
    }
  }

  const HardScene& of_;
  const PartsChoice choice_;
  const Budget& budget_;
  Metrics whole_;
  double seconds_ = 0;  // that its row took
  double ledger_bytes_ = 0, ledger_launches_ = 0, ledger_ms_ = 0;
};

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
      {"friction in the plane", [](const Scene& s) { return !s.fabric.in_plane.empty(); },
       [](Scene& s) { s.fabric.in_plane = {}; }},
      {"damping of bending", [](const Scene& s) { return s.fabric.damping > 0; },
       [](Scene& s) { s.fabric.damping = 0; }},
      {"drag of the air", [](const Scene& s) { return s.air_drag > 0; }, [](Scene& s) { s.air_drag = 0; }}};
}

std::vector<Metrics> cost_of_parts(const HardScene& of, const PartsChoice& choice, const Budget& budget,
                                   const std::function<void(const Metrics&)>& measured) {
  PartsOfScene parts(of, choice, budget);
  std::vector<Metrics> rows;
  const auto add = [&](Metrics row) {
    measured(row);
    rows.push_back(std::move(row));
  };
  add(parts.as_it_is());
  for (const Omission& omission : omissions())
    if (omission.is_there(of.scene)) add(parts.without(omission));
  add(parts.without_ledger());
  return rows;
}

}  // namespace hysteron::experiments
