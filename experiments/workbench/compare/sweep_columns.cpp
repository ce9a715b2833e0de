#include "experiments/workbench/compare/sweep_columns.h"

#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <mutex>
#include <set>
#include <thread>
#include <utility>

#include "experiments/workbench/app/gpu_choice.h"
#include "experiments/workbench/app/json_file.h"
#include "experiments/workbench/app/manifest_file.h"
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

// What was asked of a finished column, and of which program: it stands in its folder.
constexpr const char* kAsked = "asked.json";

// Words after `hysteron`.
std::vector<std::string> words_of(const CommandLine& line) {
  std::vector<std::string> words = {line.experiment};
  for (const Flag& flag : line.flags) words.push_back("--" + flag.path + "=" + flag.text);
  return words;
}

Json asked(const SweepColumn& column) {
  return {{"commit", kGitCommit}, {"dirty", kGitDirty}, {"words", words_of(column.line)}};
}

std::vector<std::string> command_of(const SweepColumn& column, const SweepJobs& jobs, int threads, int gpu) {
  std::vector<std::string> words = {"env"};
  if (gpu >= 0) words.push_back("CUDA_VISIBLE_DEVICES=" + visible_gpu(gpu));
  for (const char* others : {"OMP_NUM_THREADS=", "LP_NUM_THREADS="})  // libraries' and Mesa's own threads
    words.push_back(others + std::to_string(threads));
  words.push_back(fs::read_symlink("/proc/self/exe").string());
  for (const std::string& word : words_of(column.line)) words.push_back(word);
  words.push_back("--quiet=true");
  words.push_back("--out=" + column.folder.string());
  if (experiment_named(column.line.experiment).simulates)
    words.push_back("--threads=" + std::to_string(threads));
  if (jobs.checkpoints && last_text(column.line.flags, "checkpoint", "0") != "0")
    words.push_back("--resume=true");
  return words;
}

// Why a run ended without having finished.
std::string reason_of(const ProcessResult& result) {
  if (!result.first_error_line.empty()) return result.first_error_line;
  return result.exit_code < 0 ? "ended by a signal"
                              : "ended with exit code " + std::to_string(result.exit_code);
}

void run_column(SweepColumn& column, const SweepJobs& jobs, int threads, int gpu) {
  std::error_code ignored;
  fs::remove(column.folder / kAsked, ignored);
  const auto start = std::chrono::steady_clock::now();
  const ProcessResult result = run_process(command_of(column, jobs, threads, gpu), "");
  column.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  column.manifest = manifest_or_none(column.folder / "manifest.json");
  column.exit_code = result.exit_code;
  if (!result.started) throw Error::machine("cannot start the run " + column.name);
  if (jobs.go_on && result.exit_code != 0 && result.exit_code != 3) {
    column.manifest.reset();  // of an earlier run
    column.stopped = reason_of(result);
    return;
  }
  if (result.exit_code == 2) throw Error::request(column.name + ": " + result.first_error_line);
  if (result.exit_code != 0 && result.exit_code != 3)
    throw Error::machine(column.name + ": " + result.first_error_line);
  if (result.exit_code == 3) column.stopped = reason_of(result);
  write_text(column.folder / kAsked, asked(column).dump(2) + "\n");
}

// The last whole line of a table that grows; "" before it has a row.
std::string last_row(const fs::path& file) {
  std::ifstream stream(file);
  std::string last, line;
  std::getline(stream, line);  // the head
  while (std::getline(stream, line) && !stream.eof()) last = line;
  return last;
}

// Says every few seconds how far the columns are that run, where that has changed, until its end.
class Watch {
 public:
  Watch(const std::vector<SweepColumn>& columns, const std::function<void(const std::string&)>& say)
      : columns_(columns), say_(say), thread_([this] { run(); }) {}
  ~Watch() {
    {
      const std::lock_guard lock(mutex_);
      ended_ = true;
    }
    wake_.notify_all();
    thread_.join();
  }
  Watch(const Watch&) = delete;
  Watch& operator=(const Watch&) = delete;

  void begin(std::size_t column) {
    const std::lock_guard lock(mutex_);
    running_.insert(column);
  }
  void end(std::size_t column) {
    const std::lock_guard lock(mutex_);
    running_.erase(column);
  }

 private:
  void run() {
    constexpr auto kInterval = std::chrono::seconds(2);
    std::unique_lock lock(mutex_);
    while (!wake_.wait_for(lock, kInterval, [this] { return ended_; })) {
      std::vector<std::string> words;
      for (const std::size_t column : running_) {
        const std::string so_far = progress_in(columns_[column].folder);
        if (!so_far.empty()) words.push_back(columns_[column].name + " " + so_far);
      }
      const std::string line = join(words, ", ");
      if (!line.empty() && line != std::exchange(said_, line)) say_(line);
    }
  }

  const std::vector<SweepColumn>& columns_;
  const std::function<void(const std::string&)>& say_;
  std::mutex mutex_;
  std::condition_variable wake_;
  std::set<std::size_t> running_;
  std::string said_;
  bool ended_ = false;
  std::thread thread_;  // the last: it reads the others
};

// The GPU with the fewest runs on it, for each run that begins.
class GpuQueue {
 public:
  explicit GpuQueue(int gpus) : runs_(gpus) {}
  // -1 where there is none.
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

}  // namespace

SweepColumn column_of(const std::string& name, const CommandLine& line, const std::vector<Flag>& own,
                      const fs::path& out) {
  static const std::set<std::string> kOfThePage = {"out", "json", "quiet", "resume", "threads"};
  SweepColumn column{name, line, out / name};
  std::erase_if(column.line.flags, [](const Flag& flag) { return kOfThePage.contains(flag.path); });
  column.line.flags = with_later(column.line.flags, own);
  return column;
}

void explain_columns(const std::vector<SweepColumn>& columns) {
  for (const SweepColumn& column : columns) {
    std::cout << column.name << ":" << std::endl;
    experiment_named(column.line.experiment).run(column.line);
  }
}

bool recall(SweepColumn& column) {
  std::optional<Manifest> manifest = manifest_or_none(column.folder / "manifest.json");
  column.kept = manifest && manifest->complete && json_or_none(column.folder / kAsked) == asked(column);
  if (column.kept) column.manifest = std::move(manifest);
  return column.kept;
}

std::string outcome_of(const SweepColumn& column) {
  return column.kept ? "kept" : column.stopped.empty() ? "done" : column.stopped;
}

std::string progress_in(const fs::path& folder) {
  const std::string row = last_row(folder / "metrics.csv.part");
  const std::optional<Manifest> manifest = manifest_or_none(folder / "manifest.json");
  if (row.empty() || !manifest || !manifest->scene.seconds) return "";
  return fmt::format("{:.2f}/{:.4g} s", std::strtod(row.c_str(), nullptr), *manifest->scene.seconds);
}

void run_columns(std::vector<SweepColumn>& columns, const SweepJobs& jobs,
                 const std::function<void(SweepColumn&)>& said,
                 const std::function<void(const std::string&)>& progress) {
  std::string reason;
  const int gpus = jobs.gpu ? gpu_count(reason) : 0;
  const int cores =
      jobs.cores > 0 ? jobs.cores : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  const int at_once = std::min(static_cast<int>(columns.size()),
                               jobs.at_once > 0 ? jobs.at_once : std::max(1, gpus > 0 ? gpus : cores));
  const int threads = jobs.threads > 0 ? jobs.threads : std::max(1, cores / at_once);
  std::mutex one_at_a_time;
  const std::function<void(const std::string&)> say = [&](const std::string& line) {
    const std::lock_guard lock(one_at_a_time);
    progress(line);
  };
  Watch watch(columns, say);
  GpuQueue queue(gpus);
  const auto watched = [&](std::size_t i, int its_threads) {
    watch.begin(i);
    const int gpu = queue.take();
    run_column(columns[i], jobs, its_threads, gpu);
    queue.give_back(gpu);
    watch.end(i);
  };
  const auto finish = [&](std::size_t i, int its_threads) {
    if (!jobs.resume || !recall(columns[i])) watched(i, its_threads);
    const std::lock_guard lock(one_at_a_time);
    said(columns[i]);
  };
  if (jobs.first >= 0) finish(static_cast<std::size_t>(jobs.first), jobs.threads > 0 ? jobs.threads : cores);
  in_parallel(columns.size(), at_once, [&](std::size_t i) {
    if (static_cast<int>(i) != jobs.first) finish(i, threads);
  });
}

}  // namespace hysteron::experiments
