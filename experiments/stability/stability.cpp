#include "experiments/stability/stability.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <mutex>

#include "sim/base/error.h"
#include "sim/base/parallel.h"
#include "sim/mesh/intersections.h"
#include "sim/scene/choice.h"
#include "sim/scene/scene_reader.h"
#include "sim/time/simulation.h"

namespace hysteron::experiments {
namespace {

// Number of samples of energy and stretch in a run, at most one a step, because what diverges may be damped
// away within a few more.
constexpr int kLooks = 400;

// Returns m g L [J].
double weight_energy(const Scene& scene, const ClothMesh& mesh) {
  double area = 0;
  for (const double a : mesh.vertex_area) area += a;
  Eigen::AlignedBox3d box;
  for (const auto& x : mesh.rest) box.extend(x);
  return scene.fabric.density * area * scene.gravity.norm() * box.diagonal().norm();
}

long planned_steps(const Simulation& simulation, const Scene& scene, const CellEffort& effort) {
  const bool solved = scene.is_implicit();
  const double work = solved ? kWorkOfSolvedStep : simulation.limits().substeps;
  return std::max(1L, std::lround(std::min(scene.seconds / scene.step, std::floor(effort.work / work))));
}

// Measures energy and stretch; `most_work` is the largest work of pins and obstacles so far [J].
void look(Simulation& simulation, double weight, double& most_work, Finding& finding) {
  const Ledger l = simulation.ledger();
  const double stretch = simulation.largest_stretch();
  const double now = l.kinetic + l.gravitational + l.membrane + l.bending + l.contact;
  most_work = std::max(most_work, std::abs(l.pin_work) + std::abs(l.obstacle_work));
  const double scale = l.initial + most_work + weight;
  const double excess = now - l.initial - l.pin_work - l.obstacle_work;
  const double growth = scale > 0 ? 1 + excess / scale : 1;
  finding.remainder = scale > 0 ? l.remainder / scale : 0;
  const bool finite = std::isfinite(growth) && std::isfinite(stretch);
  if (finite) finding.largest_stretch = std::max(finding.largest_stretch, stretch);
  if (finite && growth <= kLargestGrowth) {
    finding.energy_growth = std::max(finding.energy_growth, growth);
    return;
  }
  finding.outcome = Outcome::diverged;
  finding.energy_growth = growth;
  finding.message = finite ? "the energy is more than was put in" : "the energy is not finite";
}

void search_intersections(Simulation& simulation, const Cloth& cloth, Finding& finding) {
  const std::size_t crossing = intersecting_triangles(cloth.mesh.face, simulation.positions()).size();
  if (crossing == 0) return;
  finding.outcome = Outcome::diverged;
  finding.message = std::to_string(crossing) + " triangles pass through others";
}

void simulate(const Scene& scene, const Cloth& cloth, const CellEffort& effort, Finding& finding) {
  const auto simulation = make_simulation(scene, cloth);
  finding.substeps = simulation->limits().substeps;
  const long steps = planned_steps(*simulation, scene, effort);
  const double weight = weight_energy(scene, cloth.mesh);
  double most_work = 0;
  finding.outcome = Outcome::ended;
  for (int n = 1; n <= kLooks && finding.outcome == Outcome::ended; ++n) {
    const long until = steps * n / kLooks;
    if (until == finding.steps) continue;
    finding.steps = until;  // set also if advance() throws on the way
    simulation->advance(static_cast<int>(until - simulation->steps()));
    finding.seconds_simulated = simulation->time();
    look(*simulation, weight, most_work, finding);
  }
  finding.retried_steps = simulation->counts().retried;
  if (finding.outcome == Outcome::ended && scene.self_contact)
    search_intersections(*simulation, cloth, finding);
  if (finding.outcome == Outcome::ended && finding.retried_steps > 0) finding.outcome = Outcome::retried;
}

std::vector<std::string> names_of(const std::vector<Sweep>& sweeps) {
  std::vector<std::string> names = {"explicit-limit", "ripple"};  // which command.cpp runs
  for (const Sweep& sweep : sweeps) names.push_back(sweep.name);
  return names;
}

std::vector<std::string> integrators_of(const Sweep& sweep, const SweepParams& choice) {
  if (sweep.integrators.empty()) return choice.integrators;
  std::vector<std::string> common;
  for (const std::string& integrator : choice.integrators)
    if (std::count(sweep.integrators.begin(), sweep.integrators.end(), integrator))
      common.push_back(integrator);
  return common;
}

}  // namespace

std::vector<std::string> SweepParams::few_laws() const {
  if (!laws.empty()) return laws;
  if (quick) return {"prandtl"};
  return {"linear", "prandtl", "wong"};
}

Finding probe_stability(const Attempt& attempt, const CellEffort& effort) {
  Finding finding;
  const auto start = std::chrono::steady_clock::now();
  Scene scene = attempt.scene;
  scene.seconds = finding.requested_seconds = std::min(effort.seconds, scene.seconds);
  try {
    check_scene(scene);
    simulate(scene, attempt.mesh ? place_cloth(scene, *attempt.mesh) : make_cloth(scene), effort, finding);
  } catch (const Error& error) {
    if (error.exit_code() == 1) throw;
    finding.outcome = error.exit_code() == 2 ? Outcome::refused : Outcome::diverged;
    finding.message = error.what();
  }
  finding.wall_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return finding;
}

std::vector<Sweep> named_sweeps(const std::vector<std::string>& names, const SweepParams& choice) {
  std::vector<Sweep> all = number_sweeps(choice), sweeps;
  for (Sweep& sweep : scene_sweeps(choice)) all.push_back(std::move(sweep));
  if (names == std::vector<std::string>{"all"}) {
    std::erase_if(all, [&](const Sweep& sweep) { return integrators_of(sweep, choice).empty(); });
    return all;
  }
  for (const std::string& name : names) {
    const auto found =
        std::find_if(all.begin(), all.end(), [&](const Sweep& sweep) { return name == sweep.name; });
    if (found == all.end()) throw not_a_choice("sweep", name, names_of(all));
    if (integrators_of(*found, choice).empty())
      throw Error::invalid_input("--sweep " + name + " needs --integrator " + join(found->integrators, ", ") +
                                 ", not " + join(choice.integrators, ", "))
          .with_key("integrator", join(choice.integrators, ","));
    sweeps.push_back(*found);
  }
  return sweeps;
}

std::vector<SweepCell> untried_cells(const std::vector<Sweep>& sweeps, const SweepParams& choice) {
  std::vector<SweepCell> cells;
  for (const Sweep& sweep : sweeps)
    for (std::size_t v = 0; v < sweep.variants.size(); ++v)
      for (const std::string& integrator : integrators_of(sweep, choice))
        for (std::size_t row = 0; row < sweep.y.ticks.size(); ++row)
          for (std::size_t column = 0; column < sweep.x.ticks.size(); ++column) {
            cells.push_back({sweep.name, integrator, sweep.variants[v], sweep.x.ticks[column],
                             sweep.y.ticks[row], sweep.at(v, column, row)});
            Scene& scene = cells.back().attempt.scene;
            scene.integrator = value_named<Integrator>(integrator);
            scene.device = choice.device;
            scene.threads = 1;
          }
  return cells;
}

void try_all(std::vector<SweepCell>& cells, const CellEffort& effort, int threads,
             const std::function<void(std::size_t)>& done) {
  std::size_t finished = 0;
  std::mutex reporting;
  in_parallel(cells.size(), threads, [&](std::size_t i) {
    cells[i].finding = probe_stability(cells[i].attempt, effort);
    const std::lock_guard lock(reporting);
    done(++finished);
  });
}

}  // namespace hysteron::experiments
