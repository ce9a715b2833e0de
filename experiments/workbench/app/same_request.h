// Whether a result that is there already answers what is asked now.  A run's manifest is the one record of
// what it was asked: its resolved keys and options, its flags, a hash of every file that it has read, and the
// program.  Everything that takes a result again (--resume, --collect, checkpoints) compares it here.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "experiments/workbench/app/experiment.h"
#include "experiments/workbench/app/manifest.h"

namespace hysteron::experiments {

// Files that the job of this thread has read so far, but those in `own`, the folder that it writes to.
std::vector<InputRecord> inputs_of_job(const std::filesystem::path& own);

// "rs/c.obj has changed", of every file that was read then; each is hashed as it is now.  Files in `now` are
// read for the request already: their hashes stand there, and one that was not read then is another change.
std::vector<std::string> input_changes(const std::vector<InputRecord>& then,
                                       const std::vector<InputRecord>& now = {});

// "fabric.b2, fps": keys whose values differ between the run and the set-up, scene first; "" without any.
// Threads, and where values come from, are no part of a request.
std::string changed_keys(const Manifest& before, const Setup& setup);

// "--errors": flags about the repeats of a run, which are no part of its scene and options.
std::string changed_error_flags(const Manifest& before, const CommandLine& line);

// Of two lists of words "--fabric.b2=1e-5" the flags that differ: "--fabric.b2".
std::vector<std::string> changed_words(const std::vector<std::string>& then,
                                       const std::vector<std::string>& now);

// The tables and fabric files among these files of a run's folder.
std::vector<InputRecord> written_tables(const std::vector<std::string>& files,
                                        const std::filesystem::path& folder);
// Whether a table of that folder has the bytes that the run wrote, as far as its manifest knows.
bool is_as_written(const Manifest& run, const std::filesystem::path& folder, const std::string& table);
// "its metrics.csv is not there any more", "is not as it was written", for each file that the run wrote into
// the folder and that is gone, and for each table that is another.
std::vector<std::string> lost_files(const Manifest& run, const std::filesystem::path& folder);

// Why the complete run of that manifest is no answer to the line and its set-up; "": it is one.
std::string why_another_request(const Manifest& before, const CommandLine& line, const Setup& setup);

}  // namespace hysteron::experiments
