// Friction that was identified from some cycles of a FAB tester predicts all others in the same file.
#pragma once

#include <string>
#include <vector>

#include "experiments/fab/loops.h"
#include "experiments/fit/from_fab.h"

namespace hysteron::experiments {

// A test beside what the form asked for and what one stop say of it.
struct FabPrediction {
  ComparedLoops stops, one_stop;
  std::vector<bool> fitted;  // by cycle
  std::string fitted_on;     // "L D1 cycle 2"
  double noise = 0;          // of the force of the whole strip, from repeats where there are any [N]
};

// Every test of the directions that were fitted, and of the bias by the mean of both; tests that stretch
// where stretch was fitted.  A test that a law cannot follow is left out.
std::vector<FabPrediction> predict(const FabAnswer& answer);

// predictions.csv; loops_<loops>.csv of each: simulated and measured forces; plot_<loops> of each, and
// plot_areas of all that bend.
void write_predictions(Run& run, const std::vector<FabPrediction>& predictions);
void write_compared_loops(Run& run, const std::vector<FabPrediction>& predictions);
void draw_predictions(Run& run, const std::string& fabric, const std::vector<FabPrediction>& predictions);

// Sizes of the errors of a law on the cycles that it was not fitted to, of all tests that bend along the same
// direction with the same gauge: of the loops' areas and of the ranges of force [%].
struct HeldOutErrors {
  std::vector<double> area, range;  // by cycle; empty: there is none, or the law cannot follow one
};
HeldOutErrors held_out_errors(const FabAnswer& answer, const std::string& direction, const StopsLaw& law);

// forms.csv: what every form of friction leaves of the data it was fitted to and of those it was not, and how
// surely the data exclude it. The rows "all" hold means over the directions' held-out cycles together.
void write_forms(Run& run, const FabAnswer& answer);

}  // namespace hysteron::experiments
