// What each unknown of a fabric explains of a drape: one at a time at both ends of its range.
#pragma once

#include "experiments/validate/predictions.h"

namespace hysteron::experiments {

// For each fabric under the first law: as its file says, with each number that states a range at its ends, on
// the other tester, and with four times the triangles; each on `draws` meshes.  budget.csv,
// plot_budget_<fabric>.
void write_budget(const ValidateFlags& flags, Run& run);

}  // namespace hysteron::experiments
