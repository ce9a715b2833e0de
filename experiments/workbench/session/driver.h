// Runs a line of any experiment, and asks without running it what the line asks for.
#pragma once

#include <vector>

#include "experiments/workbench/app/experiment.h"

namespace hysteron::experiments {

// Runs the line, or the page of its laws, fabrics and integrators, and returns the exit code.  A case
// (case.h) is explained, dumped, or simulated and recorded in a folder, as its options say.  Throws what the
// experiment refuses, and Error::simulation for a run that cannot go on.
int run_experiment(const CommandLine& line);

// Throws what the experiment of each column's line refuses, with the column's name before it, without
// building a cloth or taking its folder.
void check_columns(const std::vector<ChildRun>& columns);
// Prints what each column includes and leaves out (--explain).
void explain_columns(const std::vector<ChildRun>& columns);

}  // namespace hysteron::experiments
