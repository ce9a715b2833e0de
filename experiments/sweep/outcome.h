// How a run of a study ended, as it stands in its folder: what a table needs that no manifest says.
#pragma once

#include "experiments/workbench/compare/sweep_columns.h"

namespace hysteron::experiments {

// FOLDER/outcome.json: exit code and, of a run that is not complete, why.  Throws Error::system.
void write_outcome(const ChildRun& run);

// It was refused or could not go on: another attempt would end in the same way.
bool is_settled(const ChildRun& run);

// What an earlier `sweep`, wherever it ran, has left of the run: kept, stopped, or "not run".
void recall_outcome(ChildRun& run);

}  // namespace hysteron::experiments
