// `hysteron kes --test shear|tension` runs the KES-FB1 tests.
#pragma once

#include "experiments/workbench/app/experiment.h"

namespace hysteron::experiments {

int run_in_plane(const CommandLine& line);
// Returns the keys of the in-plane tests that the bending test does not have.
std::vector<KeyDescription> in_plane_keys();

}  // namespace hysteron::experiments
