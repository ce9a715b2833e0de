// Measures how much each unknown of a fabric explains of a drape, one at a time at both ends of its range.
#pragma once

#include <string>
#include <vector>

#include "experiments/validate/drapes.h"

namespace hysteron::experiments {

// A drape with one number changed: "shear", "30".
struct Trial {
  std::string number, value;
  Drape drape;
};
// Returns the nominal drape, each number with a stated range at its low and its high end, the other tester,
// and four times the triangles.
std::vector<Trial> budget_trials(const std::string& fabric, const ValidateFlags& flags);

// Runs each trial of each fabric under the first law on `draws` meshes, and writes budget.csv and
// plot_budget_<fabric>.
void write_budget(const ValidateFlags& flags, Run& run);

}  // namespace hysteron::experiments
