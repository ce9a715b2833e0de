#include "experiments/workbench/compare/column_process.h"

#include <algorithm>
#include <chrono>
#include <exception>
#include <map>
#include <set>
#include <utility>

#include "experiments/workbench/app/ending.h"
#include "experiments/workbench/app/gpu_choice.h"
#include "experiments/workbench/app/json_file.h"
#include "experiments/workbench/app/manifest_file.h"
#include "experiments/workbench/app/version.h"
#include "sim/base/atomic_file.h"
#include "sim/base/error.h"
#include "sim/base/process.h"

namespace hysteron::experiments {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

// What was asked of a column that has ended, of which program, and how it ended: it stands in its folder.
constexpr const char* kOutcome = "outcome.json";
constexpr int kNotRun = -1;  // as an exit code

// Words after `hysteron`.
std::vector<std::string> line_arguments(const CommandLine& line) {
  std::vector<std::string> words = {line.experiment};
  words.insert(words.end(), line.positionals.begin(), line.positionals.end());
  for (const Flag& flag : line.flags) words.push_back("--" + flag.path + "=" + flag.text);
  return words;
}

Json requested(const ChildRun& column) {
  return {{"commit", kGitCommit}, {"dirty", kGitDirty}, {"words", line_arguments(column.line)}};
}

bool takes_checkpoints(const ChildRun& column) {
  return last_text(column.line.flags, "checkpoint", "0") != "0";
}

// This program with its share of the machine.
std::vector<std::string> program_with(ProcessShare process_share) {
  std::vector<std::string> words = {"env"};
  if (process_share.gpu >= 0) words.push_back("CUDA_VISIBLE_DEVICES=" + visible_gpu(process_share.gpu));
  for (const char* others : {"OMP_NUM_THREADS=", "LP_NUM_THREADS="})  // libraries' and Mesa's own threads
    words.push_back(others + std::to_string(process_share.threads));
  words.push_back(fs::read_symlink("/proc/self/exe").string());
  return words;
}

// Words after `hysteron` of the column's run.
std::vector<std::string> child_arguments(const ChildRun& column, const SweepJobs& jobs, int threads) {
  std::vector<std::string> words = line_arguments(column.line);
  words.push_back("--quiet=true");
  words.push_back("--out=" + column.folder.string());
  if (experiment_named(column.line.experiment).simulates)
    words.push_back("--threads=" + std::to_string(threads));
  if (jobs.checkpoints && takes_checkpoints(column)) words.push_back("--resume=true");
  return words;
}

// Why a run ended without having finished.
std::string ending_reason(int exit_code, const std::string& first_error_line) {
  if (!first_error_line.empty()) return first_error_line;
  return exit_code < 0 ? "ended by a signal" : "ended with exit code " + std::to_string(exit_code);
}

// Of a run without a folder nothing is left.
void write_outcome(const ChildRun& column, bool make_folder) {
  std::error_code ignored;
  if (make_folder) fs::create_directories(column.folder, ignored);
  if (!fs::is_directory(column.folder, ignored)) return;
  const Json outcome = {
      {"asked", requested(column)}, {"exit_code", column.exit_code}, {"stopped", column.stopped}};
  write_text(column.folder / kOutcome, outcome.dump(2) + "\n");
}

// What the run has left.
void take_back(ChildRun& column, const SweepJobs& jobs, int exit_code, const std::string& error) {
  const bool has_results = exit_code == 0 || exit_code == kCouldNotGoOn;
  column.exit_code = exit_code;
  if (!has_results && !jobs.tolerates_failures) {
    const std::string why = column.name + ": " + error;
    throw exit_code == 2 ? Error::invalid_input(why) : Error::system(why);
  }
  if (exit_code != 0) column.stopped = ending_reason(exit_code, error);
  if (has_results) column.manifest = manifest_or_none(column.folder / "manifest.json");
  write_outcome(column, jobs.keep_reasons);
}

// Why the run cannot share a process; "": it can.
std::string why_not_batchable(const CommandLine& line) {
  const Experiment& experiment = experiment_named(line.experiment);
  if (!experiment.simulates || experiment.timed)
    return "is of runs that step a cloth, not of " + line.experiment;
  if (last_text(line.flags, "errors", "") == "true")
    return "is of runs without errors, whose repeats are processes of their own (errors.batch)";
  if (last_text(line.flags, "no-images", "") != "true")
    return "is of runs without pictures, with no-images among their keys";
  return "";
}

}  // namespace

bool recall(ChildRun& column) {
  std::optional<Manifest> manifest = manifest_or_none(column.folder / "manifest.json");
  const Json outcome = json_or_none(column.folder / kOutcome);
  column.kept = manifest && manifest->complete && outcome.is_object() &&
                outcome.value("asked", Json()) == requested(column);
  if (column.kept) column.manifest = std::move(manifest);
  return column.kept;
}

void recall_outcome(ChildRun& column) {
  if (recall(column)) return;
  const Json outcome = json_or_none(column.folder / kOutcome);
  const bool known = outcome.is_object() && outcome.value("exit_code", Json()).is_number_integer() &&
                     outcome.value("stopped", Json()).is_string();
  column.exit_code = known ? outcome["exit_code"].get<int>() : kNotRun;
  column.stopped = known ? outcome["stopped"].get<std::string>() : "";
  if (column.stopped.empty()) column.stopped = "not run", column.exit_code = kNotRun;
  if (column.exit_code == kCouldNotGoOn) column.manifest = manifest_or_none(column.folder / "manifest.json");
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
  std::map<std::pair<std::string, bool>, std::size_t> open;  // those that take more columns of a kind
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

// The process is `hysteron batch`, which says of its columns as they end.
void run_chunk(std::vector<ChildRun>& columns, const Chunk& chunk, const SweepJobs& jobs,
               ProcessShare process_share, const std::function<void(std::size_t)>& ended) {
  std::error_code ignored;
  for (const std::size_t i : chunk) fs::remove(columns[i].folder / kOutcome, ignored);
  std::set<std::size_t> waiting(chunk.begin(), chunk.end());
  Clock::time_point begun = Clock::now();
  std::exception_ptr failure;
  const auto end = [&](std::size_t i, int exit_code, const std::string& error) {
    waiting.erase(i);
    const Clock::time_point now = Clock::now();
    columns[i].seconds = std::chrono::duration<double>(now - std::exchange(begun, now)).count();
    try {
      take_back(columns[i], jobs, exit_code, error);
      ended(i);
    } catch (...) {
      if (!failure) failure = std::current_exception();
    }
  };
  const auto hear = [&](const std::string& line) {
    const Json said = parsed_json(line);
    if (said.is_object()) end(chunk.at(said.at("run")), said.at("exit_code"), said.at("error"));
  };
  std::vector<std::string> command = program_with(process_share);
  command.push_back("batch");
  std::string lines;
  for (const std::size_t i : chunk)
    lines += Json(child_arguments(columns[i], jobs, process_share.threads)).dump() + "\n";
  const ProcessResult result = run_process(command, lines, hear);
  if (!result.started) throw Error::system("cannot start the run " + columns[chunk[0]].name);
  for (const std::size_t i : std::set(waiting)) end(i, result.exit_code, result.first_error_line);
  if (failure) std::rethrow_exception(failure);
}

}  // namespace hysteron::experiments
