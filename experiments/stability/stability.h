// Stability is measured in two ways: by many short simulations, each at one place of a sweep, with their
// outcomes; and by the largest stable substep of explicit bending, beside the bound that the program uses.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "render/heat_map.h"
#include "sim/mesh/cloth_mesh.h"
#include "sim/scene/scene.h"

namespace hysteron::experiments {

enum class Outcome {
  ended,     // reached its end with finite numbers and bounded energy
  retried,   // the same, with some steps repeated in halves
  refused,   // the program did not start it, and says why
  diverged,  // broken off, not finite, with more energy than was put in, or with crossing layers
};
constexpr std::array<const char*, 4> names(Outcome) { return {"ended", "retried", "refused", "diverged"}; }

// A simulation to try; scene.seconds is its full length.
struct Attempt {
  Scene scene;
  std::optional<ClothMesh> mesh = {};  // if empty, the scene's own
};

// Limits of a simulation: `seconds` of simulated time, but no more steps than the work allows, and at least
// one.  An explicit substep is 1 of work, a step that solves for all forces at once kWorkOfSolvedStep.
struct CellEffort {
  double seconds = 1;
  double work = 4000;
};
inline constexpr double kWorkOfSolvedStep = 20;

struct Finding {
  Outcome outcome = Outcome::refused;
  std::string message;  // reason of refusals and of broken-off runs
  // Largest of (E - E0 - W + S)/S over the run; E is the total energy of the ledger, gravity counted from the
  // start, E0 the initial one, W the work of pins and obstacles, S = E0 + |W| + m g L (L the diagonal of the
  // cloth at rest) the available energy.  A method that creates no energy stays at or below 1.
  double energy_growth = 0;
  double remainder = 0;        // remainder of the ledger at the end, over S
  double largest_stretch = 0;  // largest principal stretch minus 1 over the run
  double requested_seconds = 0, seconds_simulated = 0;
  long steps = 0, retried_steps = 0;
  int substeps = 0;
  double wall_seconds = 0;
};

// Beyond this energy growth a run counts as diverged.  Explicit bending conserves a neighbouring energy, from
// which the true one departs by up to 1/(1 - 0.75^2) - 1 in the least stable mode alone
// (sim/time/simulation.cpp) and by much less if all modes share it.
inline constexpr double kLargestGrowth = 1.1;

// Tries the simulation.  Refusals and broken-off runs are findings; Error::system is thrown.
Finding probe_stability(const Attempt& attempt, const CellEffort& effort);

// A sweep is one map for each variant and integrator.
struct Sweep {
  std::string name;   // "bending-step"
  std::string title;  // one line
  render::CellAxis x, y;
  std::vector<std::string> variants;  // "prandtl", "hinge"
  std::function<Attempt(int variant, int column, int row)> at;
  std::vector<std::string> integrators = {};  // integrators it concerns; empty: any
};

// The choices that the sweeps cover.
struct SweepParams {
  std::vector<std::string> integrators = {"semi-implicit", "implicit", "bdf2", "tr-bdf2", "explicit"};
  std::vector<std::string> laws = {};  // empty: linear, prandtl and wong in maps, all in extreme scenes
  DeviceChoice device = DeviceChoice::cpu;
  bool quick = false;

  std::vector<std::string> few_laws() const;  // the named laws, or those of maps
};
std::vector<Sweep> number_sweeps(const SweepParams& choice);  // maps.cpp
std::vector<Sweep> scene_sweeps(const SweepParams& choice);   // scenes.cpp
// Returns the named sweeps of both kinds, in this order, or for "all" those that concern one of the choice's
// integrators.  Throws Error::invalid_input for an unknown name, and for one that concerns none of these
// integrators.
std::vector<Sweep> named_sweeps(const std::vector<std::string>& names, const SweepParams& choice);

// A cell of a map with its finding.
struct SweepCell {
  std::string sweep, integrator, variant, x, y;  // names and ticks
  Attempt attempt;
  Finding finding = {};
};
// Returns the cells of all sweeps under all integrators, not yet tried.
std::vector<SweepCell> untried_cells(const std::vector<Sweep>& sweeps, const SweepParams& choice);
// Tries the cells, `threads` at a time; `done` is called after each with the number done.
void try_all(std::vector<SweepCell>& cells, const CellEffort& effort, int threads,
             const std::function<void(std::size_t done)>& done);

inline constexpr double kLinearWave = 1e-9;  // largest amplitude of a wave without coupling [m]

// A square of 0.2 m and 128 triangles without gravity, whose vertices are shaken out of its plane.
struct LimitCase {
  MeshFamily mesh = MeshFamily::random;
  BendingElement element = BendingElement::shape;
  bool held = false;  // held by its left edge
  std::string law = "linear";
  double damping = 0;  // fabric.damping [s]
  // Amplitude of the shaking that must stay bounded, beside that of a linear wave [m].  Larger waves couple
  // with the membrane and can gain energy at isolated steps far below the linear limit, as if they resonated
  // with the steps (Schlick, Mandziuk, Skeel & Srinivas 1998, J. Comput. Phys. 140:1): without damping one
  // mode then grows to some ten times the energy of all and stays there, which no smaller bound excludes.
  double amplitude = kLinearWave;
  bool resonates() const { return amplitude > kLinearWave; }
};

struct MeasuredLimit {
  LimitCase of;
  double bound = 0;               // the program's bound [s]
  double measured = 0;            // largest step up to which the energy stayed bounded at all steps tried [s]
  bool is_beyond_search = false;  // true: every tried step stayed bounded, so the limit is only a lower bound
  double ratio() const { return measured / bound; }
};

// Tries steps of so many substeps from kMinRatio of the bound upwards (by 8 % if waves may resonate), then
// bisects between the last bounded one and the next one, to 1 %.  A limit below kMinRatio is given as 0, one
// above kMaxRatio as that, and marked.
inline constexpr double kMinRatio = 0.3, kMaxRatio = 3;
MeasuredLimit measure_limit(const LimitCase& of, int substeps);

// Returns all mesh families and both elements, law by law and amplitude by amplitude, some of them also held;
// for `quick` only the first, free.
std::vector<LimitCase> limit_cases(bool quick);

}  // namespace hysteron::experiments
