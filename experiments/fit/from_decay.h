// `fit --decay`: a fabric's bending friction from the amplitudes of a free vibration.
#pragma once

#include "experiments/fit/from_fab.h"
#include "sim/identification/decay_friction.h"

namespace hysteron::experiments {

struct DecayFlags {
  std::string file;
  double length = 0;    // of the strip below the clamp [m]
  double noise = 5e-4;  // of the amplitudes [m]
};

// fabric.toml, forms.csv, decay.csv (measured and by the fit), a plot and metrics; what a reader is told.
std::string report_decay(Run& run, const DecayFlags& flags, double density, double rigidity,
                         const FabricNotes& notes, bool pictures);

}  // namespace hysteron::experiments
