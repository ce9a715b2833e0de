// Runs the columns of a comparison, each in a process of its own or several in one, with several processes at
// a time.
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
  std::string name;  // name of its folder
  CommandLine line;  // excludes --out, --threads and others that do not affect the result
  std::filesystem::path folder;
  // These are set by run_columns().
  bool kept = false;      // true if from an earlier comparison
  std::string stopped{};  // why it could not go on; empty if complete
  int exit_code = 0;
  double seconds = 0;  // wall clock of its process [s]; in a shared process, since the previous run ended
  std::optional<Manifest> manifest{};
  // Changes since the run in its folder, so that it is no result of this request; "" if there are none, or
  // there is no run.
  std::string changed{};

  Metrics metrics() const { return manifest ? manifest->metrics : Metrics(); }
};

// Returns a column with the line and its own flags, in OUT/<name>/, without what the page keeps for itself.
ChildRun child_run(const std::string& name, const CommandLine& line, const std::vector<Flag>& own,
                   const std::filesystem::path& out);

// Options of how the columns are run, which do not affect their results.
struct SweepJobs {
  int at_once = 0;  // number of processes; 0: one for each GPU, or for each core or `threads` of them
  int threads = 0;  // threads of each on the CPU; 0: its share of the cores
  bool resume = false;
  bool gpu = true;                  // allows GPUs
  int first = -1;                   // a column that the others need: it ends before they start; -1: none
  int cores = 0;                    // cores that they share; 0: all
  bool tolerates_failures = false;  // marks a wrong or failed run as stopped, without an error
  bool checkpoints = false;         // continues an interrupted run from its checkpoint, if it takes any
  bool keep_reasons = false;        // makes a folder for a run that did not begin, for load_outcome()
  int batch = 1;                    // most runs that share a process and, on a GPU, its launches
};
// The limit and documentation of the key `batch`.
inline constexpr int kLargestBatch = 1024;
inline constexpr char kBatchDoc[] =
    "up to so many runs share a process and, on a GPU, its launches; of runs without pictures (no-images)";
// Throws Error::invalid_input if one of the columns cannot share a process: it draws, repeats itself for
// `errors`, is timed, or steps no cloth of its own.
void check_batch(const std::vector<ChildRun>& columns, int batch);

// The indices of columns that share a process.
using Chunk = std::vector<std::size_t>;
// Returns the chunks in the order of the columns, with `largest` in each or what is left.  Columns of a chunk
// name the same device, and all of them or none take checkpoints; the column `first` is alone.
std::vector<Chunk> batch_chunks(const std::vector<ChildRun>& columns, int largest, int first);

// Loads the finished run in the column's folder if its request, its program, and every file that it has read
// are the same; it is then `kept`.  Otherwise returns false, and `changed` gives the reason.
bool load_cached_run(ChildRun& column);
// Loads the run likewise, or how the column ended, whoever ran it; "not run" if nothing of this request is
// left.
void load_outcome(ChildRun& column);

// Returns how many processes the columns take at a time.
int processes_at_once(const std::vector<ChildRun>& columns, const SweepJobs& jobs);

// Returns "kept", "done", "done again: fabric.toml has changed", or why it stopped.
std::string run_outcome(const ChildRun& column);

// Returns the progress of an unfinished run from its folder, "1.20/4 s"; "" before its first instant.
std::string progress_in(const std::filesystem::path& folder);

// Runs the columns.  `said` is called, one at a time, as columns end, and `progress` every few seconds if the
// progress has changed.  A run that cannot go on (exit code 3) keeps its results; Error::invalid_input and
// Error::system are thrown if one is wrong or fails, unless failures are tolerated.
void run_columns(std::vector<ChildRun>& columns, const SweepJobs& jobs,
                 const std::function<void(ChildRun&)>& said,
                 const std::function<void(const std::string&)>& progress);

}  // namespace hysteron::experiments
