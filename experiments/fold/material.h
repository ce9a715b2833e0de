// What repeated bending makes of a material: its law, driven alone.
#pragma once

#include <vector>

#include "experiments/fold/specimen.h"
#include "sim/bending/laws/law_run.h"

namespace hysteron::experiments {

struct MaterialReading {
  double friction = 0;       // M0 [N]: what fatigue has left; of laws without fatigue half the loop's width
  double loop_width = 0;     // 2HB as KES-FB2 reads it, at +-100/m of a cycle of +-250/m [N]
  double permanent_set = 0;  // what fatigue has left of the bends [1/m]
};

// Tests a copy of the material, which is bent to `curvature` [1/m] now, in KES-FB2.  The test itself wears
// it, as the tester does.
MaterialReading test_material(const LawWalk& material, double curvature);

// The law of a cloth's element, alone: `prandtl` with the memory that it has there.
LawRequest law_in_cloth(const Scene& scene);

struct BendingCycle {
  int cycle = 0;
  MaterialReading material;
  double set = 0;         // curvature at zero moment, let go after the return to K = 0 [1/m]
  double dissipated = 0;  // by this cycle [J/m^2]
  double total = 0;       // by all of them so far [J/m^2]
};

// The law alone, bent from 0 to choice.curvature and back choice.cycles times: the chosen cycles.  Throws
// Error::invalid_input as run_law() does.
std::vector<BendingCycle> bend_repeatedly(const Scene& scene, const FoldChoice& choice);

}  // namespace hysteron::experiments
