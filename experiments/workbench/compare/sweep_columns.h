// The runs that a comparison sets side by side: each a process of its own, or several in one; several
// processes at a time.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "experiments/workbench/app/experiment.h"
#include "experiments/workbench/app/manifest.h"

namespace hysteron::experiments {

struct ChildRun {
  std::string name;  // its folder's
  CommandLine line;  // without --out, --threads and what else does not matter
  std::filesystem::path folder;
  // After run_columns():
  bool kept = false;      // from an earlier comparison
  std::string stopped{};  // why it could not go on; empty: complete
  int exit_code = 0;
  double seconds =
      0;  // of wall clock that its process took; of several in one, since the one before it ended
  std::optional<Manifest> manifest{};
  // What has changed since the run that its folder holds, which is therefore no result of it; "": nothing, or
  // there is no run.
  std::string changed{};

  Metrics metrics() const { return manifest ? manifest->metrics : Metrics(); }
};

// The line with the column's own flags, in OUT/<name>/, without what the page keeps for itself.
ChildRun child_run(const std::string& name, const CommandLine& line, const std::vector<Flag>& own,
                   const std::filesystem::path& out);
// Prints what each of them includes and leaves out (--explain).
void explain_columns(const std::vector<ChildRun>& columns);

// What is not asked of the runs but of how they are run.
struct SweepJobs {
  int at_once = 0;  // 0: one for each GPU, or for each core or `threads` of them
  int threads = 0;  // of each on the CPU; 0: its share of the cores
  bool resume = false;
  bool gpu = true;                  // may be used
  int first = -1;                   // a column that the others need: it ends before they start; -1: none
  int cores = 0;                    // that they share; 0: all
  bool tolerates_failures = false;  // a run that is wrong or fails is only marked as stopped
  bool checkpoints = false;         // a run that was interrupted goes on from its own, if it takes any
  bool keep_reasons = false;        // a run that did not begin has a folder, too, for recall_outcome()
  int batch = 1;                    // the most that share a process and, on a GPU, its launches
};
// Of the key `batch` of what runs columns.
inline constexpr int kLargestBatch = 1024;
inline constexpr char kBatchDoc[] =
    "up to so many runs share a process and, on a GPU, its launches; of runs without pictures (no-images)";
// Throws Error::invalid_input where one of the columns cannot share a process: it draws, repeats itself for
// `errors`, is timed, or steps no cloth of its own.
void check_batch(const std::vector<ChildRun>& columns, int batch);

// Columns that share a process, by their places.
using Chunk = std::vector<std::size_t>;
// In the order of the columns, `largest` in each or what is left.  Those of a chunk name the same device, and
// all of them or none take checkpoints; the column `first` is by itself.
std::vector<Chunk> batch_chunks(const std::vector<ChildRun>& columns, int largest, int first);

// Takes the finished run that the column's folder holds, if it was asked for the same by the same words, of
// the same program, and every file that it has read is the same: it is then `kept`.  Else false, and
// `changed` says why.
bool recall(ChildRun& column);
// The same, or how the column ended, whoever ran it; "not run" where nothing is left of it that was asked for
// the same.
void recall_outcome(ChildRun& column);

// How many processes the columns take at a time.
int processes_at_once(const std::vector<ChildRun>& columns, const SweepJobs& jobs);

// "kept", "done", "done again: fabric.toml has changed", or why it stopped.
std::string run_outcome(const ChildRun& column);

// "1.20/4 s": how far a run has come that is not finished, by its folder; "" before its first instant.
std::string progress_in(const std::filesystem::path& folder);

// `said` is called, one at a time, as columns end, and `progress` every few seconds with how far each is,
// where that has changed.  A run that cannot go on (exit code 3) keeps what it has; Error::invalid_input and
// Error::system if one of them is wrong or fails, unless the jobs go on.
void run_columns(std::vector<ChildRun>& columns, const SweepJobs& jobs,
                 const std::function<void(ChildRun&)>& said,
                 const std::function<void(const std::string&)>& progress);

}  // namespace hysteron::experiments
