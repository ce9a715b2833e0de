// The table of a validation: what was fitted on what, what it predicts, what was measured.
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "experiments/validate/validate.h"
#include "experiments/workbench/app/run.h"

namespace hysteron::experiments {

struct Prediction {
  std::string question;   // "drape of wool-tropical"
  std::string fitted_on;  // what the model had been told
  std::string unit;
  double predicted = NAN, measured = NAN;
  double low = NAN, high = NAN;  // 95 %: between which it lies with what is not known; NaN: not asked

  double error() const { return predicted - measured; }
  double error_percent() const { return 100 * error() / measured; }
  bool has_interval() const { return std::isfinite(low) && std::isfinite(high); }
  bool contains_measured() const { return low <= measured && measured <= high; }
};

// predictions.csv.
void write_predictions(Run& run, const std::vector<Prediction>& predictions);

// B and 2HB of ten published pairs as the virtual KES-FB2 reads them off the law that was made from them with
// the shape of friction that the fabrics' files assume: whether the fabric's numbers mean what the tester's
// do.
std::vector<Prediction> predict_pairs(Run& run);

// Areas and ranges of force of the loops in `folder`, where `fit --fab` has predicted them: with its stops,
// and with the one stop that describes the fitted cycle best.  Throws Error::invalid_input where it has none.
std::vector<Prediction> predict_loops(const std::string& folder);

}  // namespace hysteron::experiments
