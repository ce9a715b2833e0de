// A folder of recorded runs as a workflow that writes all of it anew, as results/ was written.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/workbench/app/experiment.h"
#include "experiments/workbench/compare/workflow.h"

namespace hysteron::experiments {

struct RecordedWorkflow {
  Workflow workflow;                  // a job for each run, named after its folder or its manifest's file
  std::vector<std::string> left_out;  // runs that cannot be repeated, in words
};

// Of every manifest below `folder`, whatever its file's name; those inside another run's folder belong to it.
// OUT/NAME is the repetition of FOLDER/NAME, and OUT/index.html the page of all.  Runs ask for as many cores
// as they had, for a GPU where they had one, unless `flags` (of rerun: threads, device, ...) say otherwise,
// and for four times as long as they took.  Throws Error::system, Error::invalid_input where there are none.
RecordedWorkflow workflow_of_runs(const std::filesystem::path& folder, const std::filesystem::path& out,
                                  const std::vector<Flag>& flags);

}  // namespace hysteron::experiments
