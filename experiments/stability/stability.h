// The map of what stays stable: many short simulations, each at one place of a sweep, and their outcomes.
#pragma once

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "render/heat_map.h"
#include "sim/mesh/cloth_mesh.h"
#include "sim/scene/scene.h"
#include "sim/time/simulation.h"

namespace hysteron::experiments {

enum class Outcome {
  ended,     // to its end with finite numbers and bounded energy
  retried,   // the same, some steps taken again in halves
  refused,   // the program does not start it, and says why
  diverged,  // broken off, not finite, with more energy than was put in, or with crossing layers
};
constexpr std::array<const char*, 4> names(Outcome) { return {"ended", "retried", "refused", "diverged"}; }

// What is tried.
struct Attempt {
  Scene scene;
  std::function<ClothMesh()> mesh = {};  // null: the scene's own
  double most_seconds = 1e30;            // of simulated time: when all that is asked has happened
};

// How long: `seconds` of simulated time, but no more steps than the work allows, and at least one.  An
// explicit substep is 1 of work, a step that solves for all forces at once kWorkOfSolvedStep.
struct CellEffort {
  double seconds = 1;
  double work = 4000;
};
inline constexpr double kWorkOfSolvedStep = 20;

struct Finding {
  Outcome outcome = Outcome::refused;
  std::string message;  // of refusals and of runs that broke off
  // Largest of (E - E0 - W + S)/S over the run; E the total energy of the ledger, gravity counted from the
  // start, E0 the initial one, W the work of handles and obstacles, S = E0 + |W| + m g L (L the diagonal of
  // the cloth at rest) the energy that can be had.  A method that creates no energy stays at or below 1.
  double energy_growth = 0;
  double remainder = 0;        // of the ledger at the end, over S: what its terms do not explain
  double largest_stretch = 0;  // largest principal stretch minus 1 over the run
  double requested_seconds = 0, seconds_simulated = 0;
  long steps = 0, retried_steps = 0;
  int substeps = 0;
  double wall_seconds = 0;
};

// Beyond this energy growth a run counts as diverged.  Explicit bending conserves a neighbouring energy, from
// which the true one departs by up to 1/(1 - 0.75^2) - 1 in the least stable mode alone
// (sim/solve/simulation.cpp) and by much less where all modes share it.
inline constexpr double kLargestGrowth = 1.1;

// Tries it.  What the program refuses or breaks off is a finding; Error::system is thrown.
Finding find_out(const Attempt& attempt, const CellEffort& effort);

// A row of a map of named attempts.
struct NamedAttempt {
  const char* name;
  Attempt (*make)();
};

inline Obstacle solid(ObstacleKind kind, const Eigen::Vector3d& center) {
  Obstacle obstacle;
  obstacle.kind = kind;
  obstacle.center = center;
  return obstacle;
}

// One map for each variant and integrator.
struct Sweep {
  std::string name;   // "bending-step"
  std::string title;  // one line
  render::CellAxis x, y;
  std::vector<std::string> variants;  // "prandtl", "hinge"
  std::function<Attempt(int variant, int column, int row)> at;
};

// Of named attempts, a row each, under some laws; `set` makes the variant.
template <std::size_t count>
Sweep named_sweep(const std::string& name, const std::string& title, const std::string& label,
                  const NamedAttempt (&rows)[count], const std::vector<std::string>& laws,
                  const std::vector<std::string>& variants,
                  const std::function<void(Scene&, int variant)>& set) {
  Sweep sweep{name, title, {"law", laws}, {label, {}}, variants, {}};
  for (const NamedAttempt& row : rows) sweep.y.ticks.push_back(row.name);
  sweep.at = [&rows, laws, set](int variant, int column, int row) {
    Attempt attempt = rows[row].make();
    attempt.scene.law = laws[column];
    set(attempt.scene, variant);
    return attempt;
  };
  return sweep;
}

// What the sweeps cover.
struct SweepChoice {
  std::vector<std::string> integrators = {"semi-implicit", "implicit", "bdf2", "tr-bdf2", "explicit"};
  std::vector<std::string> laws = {};  // empty: linear, prandtl and wong in maps, all in extreme scenes
  DeviceChoice device = DeviceChoice::cpu;
  bool quick = false;

  std::vector<std::string> few_laws() const;  // those named, or those of maps
};
std::vector<std::string> sweep_names();
// Those named, in this order; Error::invalid_input for an unknown name.
std::vector<Sweep> make_sweeps(const std::vector<std::string>& names, const SweepChoice& choice);

// Parts of make_sweeps(): of numbers (maps.cpp), of scenes and meshes (scenes.cpp), and of contact
// (contact_scenes.cpp).
Sweep bending_sweep(const SweepChoice& choice);
Sweep membrane_sweep(const SweepChoice& choice);
Sweep density_sweep(const SweepChoice& choice);
Sweep friction_sweep(const SweepChoice& choice);
Sweep mesh_sweep(const SweepChoice& choice);
Sweep contact_sweep(const SweepChoice& choice);
Sweep scene_sweep(const SweepChoice& choice, Precision precision);

// A cell of a map with what was found in it.
struct SweepCell {
  std::string sweep, integrator, variant, x, y;  // names and ticks
  Attempt attempt;
  Finding finding = {};
};
// The cells of all sweeps under all integrators, not yet tried.
std::vector<SweepCell> untried_cells(const std::vector<Sweep>& sweeps, const SweepChoice& choice);
// Tries them, so many at a time; `done` is called after each with how many are done.
void try_all(std::vector<SweepCell>& cells, const CellEffort& effort, int threads,
             const std::function<void(std::size_t done)>& done);

}  // namespace hysteron::experiments
