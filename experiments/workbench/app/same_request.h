// Decides whether an existing result already answers the current request.  A run's manifest is the only
// record of its request: its resolved keys and options, its flags, a hash of every file that it has read, and
// the program.  Everything that reuses a result (--resume, --collect, checkpoints) compares it here.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "experiments/workbench/app/experiment.h"
#include "experiments/workbench/app/manifest.h"

namespace hysteron::experiments {

// Returns the files that the job of this thread has read so far, except those in `own`, the folder that it
// writes to.
std::vector<InputRecord> inputs_of_job(const std::filesystem::path& own);

// Returns "rs/c.obj has changed" for every file read `then` whose current hash differs.  Files in `now` were
// already read for the request: their hashes are given, and one that was not read then is another change.
std::vector<std::string> input_changes(const std::vector<InputRecord>& then,
                                       const std::vector<InputRecord>& now = {});

// Returns "fabric.b2, fps": keys whose values differ between the run and the set-up, scene first; "" without
// any. Threads, and where values come from, are no part of a request.
std::string changed_keys(const Manifest& before, const Setup& setup);

// Returns "--errors": differing flags about the repeats of a run, which are no part of its scene and options.
std::string changed_error_flags(const Manifest& before, const CommandLine& line);

// Returns the flags, "--fabric.b2", that differ between two lists of words "--fabric.b2=1e-5".
std::vector<std::string> changed_text(const std::vector<std::string>& then,
                                      const std::vector<std::string>& now);

// Returns the tables and fabric files among these files of a run's folder.
std::vector<InputRecord> written_tables(const std::vector<std::string>& files,
                                        const std::filesystem::path& folder);
// True if a table of that folder has the bytes that the run wrote, as far as its manifest knows.
bool is_as_written(const Manifest& run, const std::filesystem::path& folder, const std::string& table);
// Returns "its metrics.csv is not there any more" or "is not as it was written" for each missing file and
// changed table of the run.
std::vector<std::string> lost_files(const Manifest& run, const std::filesystem::path& folder);

// Returns why the complete run of that manifest does not answer the line and its set-up, or "" if it does.
std::string why_another_request(const Manifest& before, const CommandLine& line, const Setup& setup);

}  // namespace hysteron::experiments
