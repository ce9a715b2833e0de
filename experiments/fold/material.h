// Tests how repeated bending changes a material, by its law alone.
#pragma once

#include <vector>

#include "experiments/fold/specimen.h"
#include "sim/bending/laws/law_run.h"

namespace hysteron::experiments {

struct MaterialReading {
  double friction = 0;       // M0 [N] after fatigue; for laws without fatigue half the loop's width
  double loop_width = 0;     // 2HB as KES-FB2 reads it, at +-100/m of a cycle of +-250/m [N]
  double permanent_set = 0;  // curvature that fatigue has made permanent [1/m]
};

// Tests a copy of the material, now bent to `curvature` [1/m], in KES-FB2.  The test itself wears the copy,
// as the tester does.
MaterialReading test_material(const LawWalk& material, double curvature);

// Returns the law of a cloth's element for use without cloth: `prandtl` has the memory that it has there.
LawRequest law_in_cloth(const Scene& scene);

struct BendingCycle {
  int cycle = 0;
  MaterialReading material;
  double set = 0;         // curvature at zero moment, let go after the return to K = 0 [1/m]
  double dissipated = 0;  // energy lost in this cycle [J/m^2]
  double total = 0;       // energy lost in all cycles so far [J/m^2]
};

// Bends the law alone from 0 to choice.curvature and back choice.cycles times; returns the chosen cycles.
// Throws Error::invalid_input as run_law() does.
std::vector<BendingCycle> bend_repeatedly(const Scene& scene, const FoldParams& choice);

}  // namespace hysteron::experiments
