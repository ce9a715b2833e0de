// Steps that Newton's method finds hard, taken again with other choices of the solver's: the table from which
// its defaults are chosen.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "experiments/bench/hard_scenes.h"
#include "experiments/workbench/app/manifest.h"

namespace hysteron::experiments {

// The states before its hardest steps.
struct HardStates {
  HardScene of;
  std::vector<std::string> states;  // Simulation::save(), hardest first
  std::string broken_off;           // why the run ended early; empty: it did not
};

// Simulates a scene to its end with the choices in use, and keeps the states before the `steps` steps that
// took most of Newton's iterations.
HardStates find_hard_steps(const HardScene& scene, int steps);

// What is compared: the first is what is in use.
struct SolverVariant {
  const char* name;
  std::function<void(SolverTuning&)> choose;
};
std::vector<SolverVariant> solver_variants();

// One row per variant and scene, and of all scenes together: Newton's iterations and linear ones over all
// steps, mean length of Newton's steps, steps taken unbalanced, halved or broken off, median and sum of
// milliseconds, largest unbalanced force over load at the end of a step.  `jobs` steps are taken at a time.
std::vector<Metrics> hard_step_table(const std::vector<HardStates>& scenes,
                                     const std::vector<SolverVariant>& variants, int jobs,
                                     const std::function<void(const std::string&)>& progress);

}  // namespace hysteron::experiments
