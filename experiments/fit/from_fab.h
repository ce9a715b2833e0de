// `fit --fab`: a fabric's friction elements from the loops of a FAB tester, and what they predict of the
// loops that were not fitted.
#pragma once

#include <string>

#include "experiments/workbench/app/run.h"
#include "sim/identification/fab_fabric.h"
#include "sim/identification/form_comparison.h"

namespace hysteron::experiments {

struct FabFlags {
  std::string file, directions, tests = "D1", cycles = "2", friction = "chapter",
                                thresholds = "1,2,4,8,16,32,64,128,256";
  double noise = 7.5e-4;
};

// Loops that were identified from, and all others of the file.
struct FabAnswer {
  FabIdentification found;
  std::vector<FabBending> one_stop;         // by direction, as found.bending
  std::vector<std::vector<FabForm>> forms;  // that friction could have as well, by direction
  std::vector<Repeats> repeats;             // of the fitted cycles, by direction
  double density = 0;                       // [kg/m^2]
  std::vector<FabLoops> loops;              // of the whole file
  std::vector<std::string> tests;           // that were fitted
  std::vector<int> cycles;
};

// Throws Error::invalid_input for what the file does not have.
FabAnswer fit_fab(const FabFlags& flags, const std::string& units, double density);

// fabric.toml, one_stop.toml (what a constant 2HB makes of the same data), spectrum.csv, forms.csv,
// predictions.csv, plots and metrics.
void report_fab(Run& run, const FabAnswer& answer, const FabricNotes& notes);

// k0, or median and spread, where friction was sought in that form; names begin with `prefix`.
void add_shape(Run& run, const FabBending& found, const std::string& prefix);

// These warnings say what is doubtful about a fit of bending, beside the other forms.
std::vector<std::string> bending_warnings(const FabBending& found, const std::vector<FabForm>& forms,
                                          const Repeats& repeats);
// The same of a fit to a free vibration, which has amplitudes in place of loops.
std::vector<std::string> decay_fit_warnings(const FabBending& found, const std::vector<FabForm>& forms,
                                            const Repeats& repeats);

// What a reader is told.
std::string summary(const FabAnswer& answer);

}  // namespace hysteron::experiments
