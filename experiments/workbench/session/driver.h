// Runs a line of any experiment.
#pragma once

#include "experiments/workbench/app/experiment.h"

namespace hysteron::experiments {

// Runs the line and returns its exit code.  One that simulates cloth is explained, dumped, or simulated and
// recorded in a folder, as its options say.  Throws what the experiment refuses, and Error::simulation for a
// run that cannot go on.
int run_experiment(const CommandLine& line);

}  // namespace hysteron::experiments
