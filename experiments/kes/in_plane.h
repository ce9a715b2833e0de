// `hysteron kes --test shear|tension`.
#pragma once

#include "experiments/workbench/app/experiment.h"

namespace hysteron::experiments {

int run_in_plane(const CommandLine& line);
// The command line takes the flags of every test: refuses those that this one, whose keys these are, has not.
void throw_if_other_tests(const CommandLine& line, const Keys& keys, const std::string& test);
// What its flags have that the bending test's have not.
std::vector<KeyDescription> in_plane_keys();

}  // namespace hysteron::experiments
