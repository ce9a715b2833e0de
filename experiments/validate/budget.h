// What each unknown of a fabric explains of a drape: one at a time at both ends of its range.
#pragma once

#include <string>
#include <vector>

#include "experiments/validate/drapes.h"

namespace hysteron::experiments {

// A drape that is told one thing more: "shear", "30".
struct Trial {
  std::string number, value;
  Drape drape;
};
// As the fabric's file says, each number that states a range at its low and its high end, the other tester,
// four times the triangles.
std::vector<Trial> budget_trials(const std::string& fabric, const ValidateFlags& flags);

// What each unknown explains.  For each fabric under the first law, each trial on `draws` meshes: budget.csv,
// plot_budget_<fabric>.
void write_budget(const ValidateFlags& flags, Run& run);

}  // namespace hysteron::experiments
