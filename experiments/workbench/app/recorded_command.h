// A run's manifest as a command line that repeats the run.
#pragma once

#include <filesystem>

#include "experiments/workbench/app/experiment.h"
#include "experiments/workbench/app/manifest.h"

namespace hysteron::experiments {

struct RecordedRun {
  std::filesystem::path file;  // its manifest
  Manifest manifest;
};

// Of a folder with a manifest, or of a manifest.  Throws Error::invalid_input, Error::system.
RecordedRun recorded_run(const std::string& folder_or_manifest);

// The same experiment with the resolved scene and keys of the manifest, or, of runs that did not note their
// keys, with the command that it holds; without a folder for the results.  Throws Error::invalid_input where
// that command is not understood any more. `later`: flags that come after its own, as far as the experiment
// takes them.
CommandLine line_that_repeats(const RecordedRun& run, const std::vector<Flag>& later = {},
                              bool with_errors = true);

// The first CSV that a flag of the line names and that is not there; "" where all are.
std::string missing_input(const CommandLine& line);

}  // namespace hysteron::experiments
