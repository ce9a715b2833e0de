// Predicts all other cycles of a FAB tester's file by the friction that was identified from some of them.
#pragma once

#include <string>
#include <vector>

#include "experiments/fab/loops.h"
#include "experiments/fit/from_fab.h"

namespace hysteron::experiments {

// A test with the predictions of the requested form and of one stop.
struct FabPrediction {
  ComparedLoops stops, one_stop;
  std::vector<bool> fitted;  // by cycle
  std::string fitted_on;     // "L D1 cycle 2"
  double noise = 0;          // of the force of the whole strip, from repeats where there are any [N]
};

// Predicts every test of the fitted directions, and of the bias by the mean of both; tests that stretch only
// if stretch was fitted.  A test that a law cannot follow is left out.
std::vector<FabPrediction> predict(const FabAnswer& answer);

// Writes predictions.csv; loops_<loops>.csv of each test with simulated and measured forces; plot_<loops> of
// each, and plot_areas of all that bend.
void write_predictions(Run& run, const std::vector<FabPrediction>& predictions);
void write_compared_loops(Run& run, const std::vector<FabPrediction>& predictions);
void draw_predictions(Run& run, const std::string& fabric, const std::vector<FabPrediction>& predictions);

// The errors of a law on the cycles that it was not fitted to, over all tests that bend along the same
// direction with the same gauge: unsigned, of the loops' areas and of the ranges of force [%].
struct HeldOutErrors {
  std::vector<double> area, range;  // by cycle; empty if there is none or the law cannot follow one
};
HeldOutErrors held_out_errors(const FabAnswer& answer, const std::string& direction, const StopsLaw& law);

// Writes forms.csv: the errors of every form of friction on fitted and held-out data, and how surely the data
// exclude it.  The rows "all" are means over the held-out cycles of all directions.
void write_forms(Run& run, const FabAnswer& answer);

}  // namespace hysteron::experiments
