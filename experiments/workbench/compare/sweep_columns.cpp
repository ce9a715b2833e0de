#include "experiments/workbench/compare/sweep_columns.h"

#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <cstdlib>
#include <exception>
#include <fstream>
#include <iostream>
#include <iterator>
#include <map>
#include <mutex>
#include <set>
#include <thread>
#include <utility>

#include "experiments/workbench/app/command_line.h"
#include "experiments/workbench/app/exit_status.h"
#include "experiments/workbench/app/gpu_choice.h"
#include "experiments/workbench/app/json_file.h"
#include "experiments/workbench/app/manifest_file.h"
#include "experiments/workbench/app/run.h"
#include "experiments/workbench/app/run_files.h"
#include "experiments/workbench/app/same_request.h"
#include "experiments/workbench/app/scene_source.h"
#include "experiments/workbench/app/this_program.h"
#include "experiments/workbench/app/version.h"
#include "experiments/workbench/compare/variants.h"
#include "sim/base/atomic_file.h"
#include "sim/base/error.h"
#include "sim/base/parallel.h"
#include "sim/base/process.h"
#include "sim/time/back_end.h"

namespace hysteron::experiments {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr int kNotRun = -1;  // in place of an exit code

// True for a flag that a page handles itself or adds to its columns' flags; it is no part of the columns'
// requests.
bool is_of_page(const std::string& flag) { return simulation_traits(flag).is_of_page(); }

// Returns the request of a column that has ended, which its folder keeps with its outcome.
Json requested(const ChildRun& column) {
  return {{"commit", kGitCommit},
          {"dirty", kGitDirty},
          {"build", program_build()},
          {"words", column.line.words()}};
}

std::vector<std::string> words_in(const Json& list) {
  std::vector<std::string> words;
  for (const Json& word : list)
    if (word.is_string()) words.push_back(word);
  return words;
}

// Returns the words recorded in a run's manifest.
std::vector<std::string> noted_text(const RunSpec& spec, const std::string& experiment) {
  CommandLine line{experiment, "", {}, spec.positionals};
  for (const auto& [path, text] : spec.flags)
    if (!is_of_page(path)) line.flags.push_back(parsed_flag(experiment, path, text));
  return line.words();
}

// Returns the words that the manifest of the column's run will record, in the parser's order.
std::vector<std::string> words_to_note(const ChildRun& column) {
  std::vector<std::string> words = column.line.words();
  words.insert(words.begin(), "hysteron");
  const auto line = parse_command_line(words, {experiment_named(column.line.experiment)});
  return line ? line->words() : words;
}

// Adds "--gravity differs" for each differing flag.
void add_differing_text(const std::vector<std::string>& then, const std::vector<std::string>& now,
                        std::vector<std::string>& changes) {
  for (const std::string& name : changed_text(then, now)) changes.push_back(name + " differs");
}

// Returns the changes since a run that was interrupted before the page could record how it ended.
std::vector<std::string> changes_since(const ChildRun& column, const Manifest& manifest) {
  std::vector<std::string> changes;
  if (manifest.spec)
    add_differing_text(noted_text(*manifest.spec, manifest.experiment), words_to_note(column), changes);
  std::ranges::copy(input_changes(manifest.inputs), std::back_inserter(changes));
  if (const std::string program = program_change(manifest); !program.empty()) changes.push_back(program);
  return changes;
}

// Returns the changes since a run that has ended; a refused run has read its files, but left no manifest.
std::vector<std::string> changes_since(const ChildRun& column, const Manifest* manifest,
                                       const Json& outcome) {
  std::vector<std::string> changes;
  const Json& asked = json_at(outcome, "asked");
  add_differing_text(words_in(json_at(asked, "words")), column.line.words(), changes);
  if (manifest) std::ranges::copy(input_changes(manifest->inputs), std::back_inserter(changes));
  if (json_at(asked, "build") != Json(program_build()))
    changes.push_back("its program is another build of " + program_version());
  return changes;
}

// The share of the machine that a process gets.
struct ProcessShare {
  int threads = 1;
  int gpu = -1;  // -1 if it has none of its own
};

bool takes_checkpoints(const ChildRun& column) {
  return last_text(column.line.flags, "checkpoint", "0") != "0";
}

// Returns the command of this program with its share of the machine.
std::vector<std::string> program_with(ProcessShare process_share) {
  std::vector<std::string> words = {"env"};
  if (process_share.gpu >= 0) words.push_back("CUDA_VISIBLE_DEVICES=" + visible_gpu(process_share.gpu));
  for (const char* others : {"OMP_NUM_THREADS=", "LP_NUM_THREADS="})  // threads of libraries and of Mesa
    words.push_back(others + std::to_string(process_share.threads));
  words.push_back(fs::read_symlink("/proc/self/exe").string());
  return words;
}

// Returns the words after `hysteron` for the column's run.
std::vector<std::string> child_arguments(const ChildRun& column, const SweepJobs& jobs, int threads) {
  std::vector<std::string> words = column.line.words();
  words.push_back("--quiet=true");
  words.push_back("--out=" + column.folder.string());
  if (experiment_named(column.line.experiment).simulates)
    words.push_back("--threads=" + std::to_string(threads));
  if (jobs.checkpoints && takes_checkpoints(column) && column.changed.empty())
    words.push_back("--resume=true");
  return words;
}

// Returns why a run ended without having finished.
std::string ending_reason(int exit_code, const std::string& first_error_line) {
  if (!first_error_line.empty()) return first_error_line;
  return exit_code < 0 ? "ended by a signal" : "ended with exit code " + std::to_string(exit_code);
}

// Records how the column ended in its folder; without a folder nothing is recorded unless `make_folder`.
void write_outcome(const ChildRun& column, bool make_folder) {
  std::error_code ignored;
  if (make_folder) fs::create_directories(column.folder, ignored);
  if (!fs::is_directory(column.folder, ignored)) return;
  const Json outcome = {
      {"asked", requested(column)}, {"exit_code", column.exit_code}, {"stopped", column.stopped}};
  write_text(column.folder / kOutcomeFile, outcome.dump(2) + "\n");
}

// Collects the results that the run has left.
void collect_result(ChildRun& column, const SweepJobs& jobs, int exit_code, const std::string& error) {
  const bool has_results = exit_code == 0 || exit_code == kCouldNotGoOn;
  column.exit_code = exit_code;
  if (!has_results && !jobs.tolerates_failures) {
    const std::string why = column.name + ": " + error;
    throw exit_code == 2 ? Error::invalid_input(why) : Error::system(why);
  }
  if (exit_code != 0) column.stopped = ending_reason(exit_code, error);
  if (has_results) column.manifest = manifest_or_none(column.folder / kManifestFile);
  write_outcome(column, jobs.keep_reasons);
}

// Returns why the run cannot share a process, or "" if it can.
std::string why_not_batchable(const CommandLine& line) {
  const Experiment& experiment = experiment_named(line.experiment);
  if (!experiment.simulates || experiment.timed)
    return "is of runs that step a cloth, not of " + line.experiment;
  if (last_text(line.flags, "errors", "") == "true")
    return "is of runs without errors, whose repeats are processes of their own (errors.batch)";
  const std::string flag = last_text(line.flags, "no-images", "");
  if (flag.empty() ? !setup_of_file(line).options.no_images : flag != "true")
    return "is of runs without pictures, with no-images among their keys";
  return "";
}

// Runs the columns of the chunk in one process, `hysteron batch`, which reports runs as they end, and
// collects their results; `ended` is called with each column's index.  A failing run does not affect the
// others: the errors of run_columns() are thrown after their end.
void run_chunk(std::vector<ChildRun>& columns, const Chunk& chunk, const SweepJobs& jobs,
               ProcessShare process_share, const std::function<void(std::size_t)>& ended) {
  std::set<std::size_t> waiting(chunk.begin(), chunk.end());
  Clock::time_point begun = Clock::now();
  std::exception_ptr failure;
  const auto end = [&](std::size_t i, int exit_code, const std::string& error) {
    waiting.erase(i);
    const Clock::time_point now = Clock::now();
    columns[i].seconds = std::chrono::duration<double>(now - std::exchange(begun, now)).count();
    try {
      collect_result(columns[i], jobs, exit_code, error);
      ended(i);
    } catch (...) {
      if (!failure) failure = std::current_exception();
    }
  };
  const auto on_line = [&](const std::string& line) {
    const Json said = parsed_json(line);
    if (said.is_object()) end(chunk.at(said.at("run")), said.at("exit_code"), said.at("error"));
  };
  std::vector<std::string> command = program_with(process_share);
  command.push_back("batch");
  std::string lines;
  for (const std::size_t i : chunk)
    lines += Json(child_arguments(columns[i], jobs, process_share.threads)).dump() + "\n";
  const ProcessResult result = run_process(command, lines, on_line);
  if (!result.started) throw Error::system("cannot start the run " + columns[chunk[0]].name);
  for (const std::size_t i : std::set(waiting)) end(i, result.exit_code, result.first_error_line);
  if (failure) std::rethrow_exception(failure);
}

// Returns the last complete line of a growing table; "" before it has a row.
std::string last_row(const fs::path& file) {
  std::ifstream stream(file);
  std::string last, line;
  std::getline(stream, line);  // skips the head
  while (std::getline(stream, line) && !stream.eof()) last = line;
  return last;
}

// Reports the progress of the running columns, or of `most` of them, every few seconds if it has changed,
// until destruction.
class Watch {
 public:
  Watch(const std::vector<ChildRun>& columns, int most, const std::function<void(const std::string&)>& say)
      : columns_(columns),
        most_(most),
        say_(say),
        thread_([this](const std::stop_token& end) { run(end); }) {}

  void begin(std::size_t column) {
    const std::lock_guard lock(mutex_);
    running_.insert(column);
  }
  void end(std::size_t column) {
    const std::lock_guard lock(mutex_);
    running_.erase(column);
  }

 private:
  void run(const std::stop_token& end) {
    constexpr auto kInterval = std::chrono::seconds(2);
    std::unique_lock lock(mutex_);
    while (true) {
      wake_.wait_for(lock, end, kInterval, [] { return false; });
      if (end.stop_requested()) return;
      std::vector<std::string> words;
      for (const std::size_t column : running_) {
        if (std::ssize(words) == most_) break;
        const std::string so_far = progress_in(columns_[column].folder);
        if (!so_far.empty()) words.push_back(columns_[column].name + " " + so_far);
      }
      const std::string line = join(words, ", ");
      if (!line.empty() && line != std::exchange(said_, line)) say_(line);
    }
  }

  const std::vector<ChildRun>& columns_;
  const int most_;
  const std::function<void(const std::string&)>& say_;
  std::mutex mutex_;
  std::condition_variable_any wake_;
  std::set<std::size_t> running_;
  std::string said_;
  std::jthread thread_;  // declared last, because it reads the others
};

// Assigns the GPU with the fewest runs to each run that begins.
class GpuQueue {
 public:
  explicit GpuQueue(int gpus) : runs_(gpus) {}
  // Returns -1 if there is no GPU.
  int take() {
    const std::lock_guard lock(mutex_);
    if (runs_.empty()) return -1;
    const auto idlest = std::min_element(runs_.begin(), runs_.end());
    ++*idlest;
    return static_cast<int>(idlest - runs_.begin());
  }
  void give_back(int gpu) {
    const std::lock_guard lock(mutex_);
    if (gpu >= 0) --runs_[gpu];
  }

 private:
  std::mutex mutex_;
  std::vector<int> runs_;
};

// The division of columns into chunks, and how many run at a time on the GPUs and cores that they share.
struct Division {
  std::vector<Chunk> chunks;
  int at_once, gpus, cores;
};
Division divided(const std::vector<ChildRun>& columns, const SweepJobs& jobs) {
  std::string reason;
  const int gpus = jobs.gpu ? gpu_count(reason) : 0;
  const int cores =
      jobs.cores > 0 ? jobs.cores : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  const int most = jobs.at_once > 0 ? jobs.at_once
                   : gpus > 0       ? gpus
                                    : std::max(1, cores / std::max(1, jobs.threads));
  // A chunk is small enough to leave work for each GPU or core.
  const int largest = std::min(jobs.batch, (static_cast<int>(columns.size()) + most - 1) / most);
  const std::vector<Chunk> chunks = batch_chunks(columns, largest, jobs.first);
  return {chunks, std::min(static_cast<int>(chunks.size()), most), gpus, cores};
}

}  // namespace

ChildRun child_run(const std::string& name, const CommandLine& line, const std::vector<Flag>& own,
                   const fs::path& out) {
  ChildRun column{name, line, out / name};
  std::erase_if(column.line.flags, [](const Flag& flag) { return is_of_page(flag.path); });
  column.line.flags = override_flags(column.line.flags, own);
  return column;
}

std::string run_outcome(const ChildRun& column) {
  if (column.kept) return "kept";
  if (!column.stopped.empty()) return column.stopped;
  return column.changed.empty() ? "done" : "done again: " + column.changed;
}

std::string progress_in(const fs::path& folder) {
  const std::string row = last_row(folder / "metrics.csv.part");
  const std::optional<Manifest> manifest = manifest_or_none(folder / kManifestFile);
  if (row.empty() || !manifest) return "";
  return fmt::format("{:.2f}/{:.4g} s", std::strtod(row.c_str(), nullptr), manifest->number("seconds"));
}

bool load_cached_run(ChildRun& column) {
  std::optional<Manifest> manifest = manifest_or_none(column.folder / kManifestFile);
  const Json outcome = json_or_none(column.folder / kOutcomeFile);
  column.kept = false;
  column.changed.clear();
  if (!outcome.is_object()) {
    if (manifest) column.changed = join(changes_since(column, *manifest), ", ");
    return false;
  }
  const int exit_code = outcome.value("exit_code", kNotRun);
  const bool has_results = exit_code == 0 || exit_code == kCouldNotGoOn;
  column.changed = join(changes_since(column, has_results && manifest ? &*manifest : nullptr, outcome), ", ");
  column.kept = exit_code == 0 && manifest && manifest->complete && column.changed.empty();
  if (column.kept) column.manifest = std::move(manifest);
  return column.kept;
}

namespace {

// True if a file of a complete run is missing: a study that goes on repeats that run, while a collected one
// needs no files.
bool lacks_a_file(ChildRun& column) {
  const std::vector<std::string> lost = lost_files(*column.manifest, column.folder);
  if (lost.empty()) return false;
  column.changed = lost.front();
  column.kept = false;
  column.manifest.reset();
  return true;
}

}  // namespace

void load_outcome(ChildRun& column) {
  if (load_cached_run(column)) return;
  const Json outcome = json_or_none(column.folder / kOutcomeFile);
  const bool known = column.changed.empty() && outcome.is_object() &&
                     outcome.value("exit_code", Json()).is_number_integer() &&
                     outcome.value("stopped", Json()).is_string();
  column.exit_code = known ? outcome["exit_code"].get<int>() : kNotRun;
  column.stopped = known ? outcome["stopped"].get<std::string>() : "";
  if (column.stopped.empty()) {
    column.stopped = column.changed.empty() ? "not run" : "not run: " + column.changed;
    column.exit_code = kNotRun;
  }
  if (column.exit_code == kCouldNotGoOn) column.manifest = manifest_or_none(column.folder / kManifestFile);
}

void check_batch(const std::vector<ChildRun>& columns, int batch) {
  if (batch <= 1) return;
  for (const ChildRun& column : columns)
    if (const std::string why = why_not_batchable(column.line); !why.empty())
      throw Error::invalid_input("batch = " + std::to_string(batch) + " " + why + " (--batch)")
          .with_key("batch", std::to_string(batch));
}

std::vector<Chunk> batch_chunks(const std::vector<ChildRun>& columns, int largest, int first) {
  std::vector<Chunk> chunks;
  std::map<std::pair<std::string, bool>, std::size_t> open;  // chunks that take more columns of a kind
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const bool alone = static_cast<int>(i) == first || largest <= 1;
    const std::pair kind{last_text(columns[i].line.flags, "device", ""), takes_checkpoints(columns[i])};
    const auto found = alone ? open.end() : open.find(kind);
    if (found != open.end() && std::ssize(chunks[found->second]) < largest) {
      chunks[found->second].push_back(i);
      continue;
    }
    if (!alone) open[kind] = chunks.size();
    chunks.push_back({i});
  }
  return chunks;
}

int processes_at_once(const std::vector<ChildRun>& columns, const SweepJobs& jobs) {
  return divided(columns, jobs).at_once;
}

void run_columns(std::vector<ChildRun>& columns, const SweepJobs& jobs,
                 const std::function<void(ChildRun&)>& said,
                 const std::function<void(const std::string&)>& progress) {
  check_batch(columns, jobs.batch);
  const Division division = divided(columns, jobs);
  const int threads = jobs.threads > 0 ? jobs.threads : std::max(1, division.cores / division.at_once);
  std::mutex one_at_a_time;
  const std::function<void(const std::string&)> say = [&](const std::string& line) {
    const std::lock_guard lock(one_at_a_time);
    progress(line);
  };
  Watch watch(columns, division.at_once, say);
  GpuQueue queue(division.gpus);
  const auto tell = [&](std::size_t i) {
    watch.end(i);
    const std::lock_guard lock(one_at_a_time);
    said(columns[i]);
  };
  const auto finish = [&](Chunk chunk, int its_threads) {
    std::erase_if(chunk, [&](std::size_t i) {
      if (!jobs.resume || !load_cached_run(columns[i]) || lacks_a_file(columns[i])) return false;
      tell(i);
      return true;
    });
    if (chunk.empty()) return;
    for (const std::size_t i : chunk) watch.begin(i);
    const int gpu = queue.take();
    run_chunk(columns, chunk, jobs, {its_threads, gpu}, tell);
    queue.give_back(gpu);
  };
  const Chunk first = {static_cast<std::size_t>(jobs.first)};
  if (jobs.first >= 0) finish(first, jobs.threads > 0 ? jobs.threads : division.cores);
  in_parallel(division.chunks.size(), division.at_once, [&](std::size_t c) {
    if (division.chunks[c] != first) finish(division.chunks[c], threads);
  });
}

}  // namespace hysteron::experiments
