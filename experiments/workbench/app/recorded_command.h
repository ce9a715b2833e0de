// Turns a run's manifest into a command line that repeats the run.
#pragma once

#include <filesystem>

#include "experiments/workbench/app/experiment.h"
#include "experiments/workbench/app/manifest.h"

namespace hysteron::experiments {

struct RecordedRun {
  std::filesystem::path file;  // its manifest
  Manifest manifest;
};

// Reads a folder with a manifest, or a manifest.  Throws Error::invalid_input, Error::system.
RecordedRun recorded_run(const std::string& folder_or_manifest);

// Returns a line with the same experiment and the resolved scene and keys of the manifest or, for runs that
// did not record their keys, with its command; without a folder for the results.  Throws Error::invalid_input
// if that command is no longer understood.  Flags in `later` come after its own, if the experiment takes
// them.
CommandLine line_that_repeats(const RecordedRun& run, const std::vector<Flag>& later = {},
                              bool with_errors = true);

// Returns the first CSV that a flag of the line names and that does not exist; "" if all do.
std::string missing_input(const CommandLine& line);

}  // namespace hysteron::experiments
