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

#include "experiments/workbench/app/manifest_file.h"
#include "experiments/workbench/compare/column_process.h"
#include "experiments/workbench/compare/variants.h"
#include "sim/base/parallel.h"
#include "sim/time/back_end.h"

namespace hysteron::experiments {
namespace {

namespace fs = std::filesystem;

// The last whole line of a table that grows; "" before it has a row.
std::string last_row(const fs::path& file) {
  std::ifstream stream(file);
  std::string last, line;
  std::getline(stream, line);  // the head
  while (std::getline(stream, line) && !stream.eof()) last = line;
  return last;
}

// Says every few seconds how far the columns are that run, or `most` of them, where that has changed, until
// its end.
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
  std::jthread thread_;  // the last: it reads the others
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

// How the columns are run: in chunks, so many at a time, which share GPUs and cores.
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
  // No larger than leaves something to each GPU or core.
  const int largest = std::min(jobs.batch, (static_cast<int>(columns.size()) + most - 1) / most);
  const std::vector<Chunk> chunks = batch_chunks(columns, largest, jobs.first);
  return {chunks, std::min(static_cast<int>(chunks.size()), most), gpus, cores};
}

}  // namespace

ChildRun child_run(const std::string& name, const CommandLine& line, const std::vector<Flag>& own,
                   const fs::path& out) {
  static const std::set<std::string> kPageFlags = {"out", "json", "quiet", "resume", "threads"};
  ChildRun column{name, line, out / name};
  std::erase_if(column.line.flags, [](const Flag& flag) { return kPageFlags.contains(flag.path); });
  column.line.flags = with_later(column.line.flags, own);
  return column;
}

void explain_columns(const std::vector<ChildRun>& columns) {
  for (const ChildRun& column : columns) {
    std::cout << column.name << ":" << std::endl;
    experiment_named(column.line.experiment).run(column.line);
  }
}

std::string run_outcome(const ChildRun& column) {
  return column.kept ? "kept" : column.stopped.empty() ? "done" : column.stopped;
}

std::string progress_in(const fs::path& folder) {
  const std::string row = last_row(folder / "metrics.csv.part");
  const std::optional<Manifest> manifest = manifest_or_none(folder / "manifest.json");
  if (row.empty() || !manifest) return "";
  return fmt::format("{:.2f}/{:.4g} s", std::strtod(row.c_str(), nullptr), manifest->number("seconds"));
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
      if (!jobs.resume || !recall(columns[i])) return false;
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
