// `fit --fab` identifies a fabric's friction elements from the loops of a FAB tester, and predicts the loops
// that were not fitted.
#pragma once

#include <string>

#include "experiments/workbench/app/run.h"
#include "sim/identification/fab_fabric.h"
#include "sim/identification/form_comparison.h"

namespace hysteron::experiments {

// The form of friction that is sought: the chapter's parabola, a lognormal distribution of thresholds, or a
// stiffness at each of given thresholds.
enum class FabFriction { chapter, shaped, stops };
constexpr std::array<const char*, 3> names(FabFriction) { return {"chapter", "shaped", "stops"}; }

struct FabFlags {
  std::string file, directions, tests = "D1", cycles = "2", thresholds = "1,2,4,8,16,32,64,128,256";
  FabFriction friction = FabFriction::chapter;
  double noise = 7.5e-4;
};

// The identification from some loops of a file, and all of its loops.
struct FabAnswer {
  FabIdentification found;
  std::vector<FabBending> one_stop;         // by direction, as found.bending
  std::vector<std::vector<FabForm>> forms;  // alternative forms of friction, by direction
  std::vector<Repeats> repeats;             // repeats of the fitted cycles, by direction
  double density = 0;                       // [kg/m^2]
  std::vector<FabLoops> loops;              // all loops of the file
  std::vector<std::string> tests;           // the fitted tests
  std::vector<int> cycles;
};

// Identifies the fabric.  Throws Error::invalid_input if the file lacks what is requested.
FabAnswer fit_fab(const FabFlags& flags, TesterUnits units, double density);

// Writes fabric.toml, one_stop.toml (a constant 2HB fitted to the same data), spectrum.csv, forms.csv,
// predictions.csv, plots and metrics.
void report_fab(Run& run, const FabAnswer& answer, const FabricNotes& notes);

// Adds k0, or median and spread, if friction was fitted in that form; names begin with `prefix`.
void add_shape(Run& run, const FabBending& found, const std::string& prefix);

// Returns warnings about what is doubtful in a fit of bending, compared with the other forms.
std::vector<std::string> bending_warnings(const FabBending& found, const std::vector<FabForm>& forms,
                                          const Repeats& repeats);
// Returns the same for a fit to a free vibration, which has amplitudes in place of loops.
std::vector<std::string> decay_fit_warnings(const FabBending& found, const std::vector<FabForm>& forms,
                                            const Repeats& repeats);

// Returns the summary that is printed.
std::string summary(const FabAnswer& answer);

}  // namespace hysteron::experiments
