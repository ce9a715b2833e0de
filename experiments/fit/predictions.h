// What stops identified from some cycles predict of all others in the same file: fitted on, predicted,
// measured, error; beside one stop.
#pragma once

#include <string>
#include <vector>

#include "experiments/fab/loops.h"
#include "experiments/fit/from_fab.h"

namespace hysteron::experiments {

struct FabPrediction {
  ComparedLoops stops, one_stop;
  std::vector<bool> fitted;  // by cycle
  std::string fitted_on;     // "L D1 cycle 2"
};

// Every test of the directions that were fitted, and of the bias by the mean of both; tests that stretch
// where stretch was fitted.  A test that a law cannot follow is left out.
std::vector<FabPrediction> predict(const FabAnswer& answer, double density);

// predictions.csv, and metrics of the largest errors.
void write_predictions(Run& run, const std::vector<FabPrediction>& predictions);
// loops_<loops>.csv of each: simulated and measured forces.
void write_compared_loops(Run& run, const std::vector<FabPrediction>& predictions);
// plot_<loops> of each, and plot_areas of all that bend.
void draw_predictions(Run& run, const std::string& fabric, const std::vector<FabPrediction>& predictions);

}  // namespace hysteron::experiments
