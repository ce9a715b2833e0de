// `hysteron kes --test shear|tension`.
#pragma once

#include "experiments/workbench/app/experiment.h"

namespace hysteron::experiments {

int run_in_plane(const CommandLine& line);
// What its flags have that the bending test's have not.
std::vector<KeyDescription> in_plane_keys();

}  // namespace hysteron::experiments
