// `hysteron sweep` runs one experiment over the axes of a study: each combination of their values is a run
// with a folder, in a process of its own or shared by several, and all are shown in one table, curves, maps
// and a page.
//
//   study file -> OUT/runs/NAME/ -> OUT/table.csv, OUT/means.csv -> plots -> OUT/report.html
#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <nlohmann/json.hpp>
#include <utility>

#include "experiments/sweep/study.h"
#include "experiments/sweep/tables.h"
#include "experiments/workbench/app/exit_status.h"
#include "experiments/workbench/app/gpu_choice.h"
#include "experiments/workbench/app/run.h"
#include "experiments/workbench/app/run_folder.h"
#include "experiments/workbench/compare/comparison.h"
#include "experiments/workbench/pages/report.h"
#include "sim/base/error.h"
#include "sim/base/number_in.h"

namespace hysteron::experiments {
namespace {

using Clock = std::chrono::steady_clock;

struct SweepParams {
  int jobs = 0, batch = 1;
  int threads = 1;
  bool resume = false;
  bool collect = false;
  std::string only, part, snakemake;
};
using S = SweepParams;
// clang-format off
const KeyRow<S> kRows[] = {
    {"jobs", at<&S::jobs>, "", between(0, 1024), "how many runs at a time; 0: one for each GPU, or for each --threads of the cores"},
    {"batch", at<&S::batch>, "", between(1, kLargestBatch), kBatchDoc},
    {"threads", at<&S::threads>, "", between(1, 1024), "of each run on the CPU"},
    {"resume", at<&S::resume>, "", any(), "go on with a study: finished runs are kept whose request, program and files are the same, interrupted ones go on from their checkpoints, and all others run"},
    {"collect", at<&S::collect>, "", any(), "run nothing: table, plots and page of the runs that are there; one whose request, program or files have changed since counts as not run"},
    {"only", at<&S::only>, "", any(), "the run of this name alone, without table and page; a finished one is kept"},
    {"part", at<&S::part>, "", any(), "K/N: only the K-th of N equal parts of the runs, without table and page; finished ones are kept"},
    {"snakemake", at<&S::snakemake>, "", any(), "folder: write the study as a Snakemake workflow there, and run nothing"},
};
// clang-format on

Keys option_keys(SweepParams& choice, Options& options) {
  Keys keys = with_output_options(bind(kRows, choice), options);
  std::erase_if(keys, [](const BoundKey& key) { return key.description.path == "quick"; });
  return keys;
}

std::vector<KeyDescription> own_keys() {
  SweepParams choice;
  Options options;
  return descriptions(option_keys(choice, options));
}

std::vector<ChildRun> study_columns(const Study& study, const std::filesystem::path& out) {
  std::vector<ChildRun> columns;
  columns.reserve(study.runs.size());
  for (const StudyRun& run : study.runs)
    columns.push_back(child_run(run.name, run_command_line(study, run), {}, out / "runs"));
  return columns;
}

SweepJobs sweep_jobs(const SweepParams& choice, const std::vector<ChildRun>& runs) {
  SweepJobs jobs;
  jobs.at_once = choice.jobs;
  jobs.threads = choice.threads;
  jobs.batch = choice.batch;
  jobs.resume = choice.resume || !choice.only.empty() || !choice.part.empty();
  jobs.checkpoints = jobs.resume;
  jobs.gpu = std::any_of(runs.begin(), runs.end(), [](const ChildRun& run) { return may_use_gpu(run.line); });
  jobs.tolerates_failures = true;
  jobs.keep_reasons = true;
  return jobs;
}

// Writes the study as a workflow: a job for each run, or for a few, and one that makes the table.
void write_study(const SweepParams& choice, const Study& study, const std::filesystem::path& out) {
  namespace fs = std::filesystem;
  const auto all = static_cast<int>(study.runs.size());
  const int jobs = (all + study.runs_a_job - 1) / study.runs_a_job;
  const std::vector<std::string> sweep = {"sweep", fs::absolute(study.file).string(), "--out",
                                          fs::absolute(out).lexically_normal().string(), "--quiet"};
  const auto with = [&](const std::vector<std::string>& more) {
    std::vector<std::string> words = sweep;
    words.insert(words.end(), more.begin(), more.end());
    return words;
  };
  Workflow workflow{.out = out, .jobs = {}, .product = "table.csv", .collects = with({"--collect"})};
  std::vector<std::string> shared_arguments = {"--threads", kThreads, "--jobs", "1"};
  if (choice.batch > 1)
    shared_arguments.insert(shared_arguments.end(), {"--batch", std::to_string(choice.batch)});
  for (int k = 1; k <= jobs; ++k) {
    std::vector<std::string> words = shared_arguments;
    words.insert(words.end(), {"--part", fmt::format("{}/{}", k, jobs)});
    workflow.jobs.push_back({std::to_string(k), with(words), study.resources});
  }
  write_workflow(choice.snakemake, workflow);
  std::cout << all << " runs in " << jobs << " jobs: " << starting_text(choice.snakemake) << "\n";
}

// Reports and counts the runs of a study as they end.
class Progress {
 public:
  Progress(const Run& run, std::size_t all) : run_(run), all_(all) {}

  void ended(const ChildRun& column) {
    ++(column.kept ? kept_ : done_);
    if (column.kept) return;
    if (!column.stopped.empty()) ++failed_;
    own_seconds_ += column.seconds;
    const long all = static_cast<long>(all_ - kept_);
    run_.progress(fmt::format("{}/{}  {}: {}{}", done_ + kept_, all_, column.name, run_outcome(column),
                              time_left(static_cast<long>(done_), all, seconds(), false)));
  }

  // Reports the progress of long runs now and then.
  void running(const std::string& line) {
    constexpr double kPatience = 30;  // [s]
    if (seconds() - said_ < kPatience) return;
    said_ = seconds();
    run_.progress("running: " + line);
  }

  // The overhead compares with `at_once` ideal cores, which would take the sum of the runs' own times over
  // their number.
  void note(Run& run, int at_once) const {
    run.metric("runs_count", all_);
    run.metric("kept_count", kept_);
    run.metric("failed_count", failed_);
    run.metric("runs_wall_s", own_seconds_);
    if (own_seconds_ > 0) run.metric("overhead_percent", 100 * (at_once * took_ / own_seconds_ - 1));
  }
  void stop() { took_ = seconds(); }

 private:
  double seconds() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }

  const Run& run_;
  std::size_t all_, done_ = 0, kept_ = 0, failed_ = 0;
  double own_seconds_ = 0, took_ = 0, said_ = 0;
  Clock::time_point start_ = Clock::now();
};

// Drops what a table does not need of a manifest, because a hundred thousand of them have to fit into memory.
void drop_scene(ChildRun& column) {
  if (!column.manifest) return;
  column.manifest->keys.reset();
  column.manifest->own.clear();
}

// Warns of an unknown metric as soon as one run has ended.  Others may still have it, so it is refused only
// at the end.
void warn_of_unknown_metric(Run& run, const Study& study, const ChildRun& first) {
  const std::string unknown = unknown_metric(study, {&first, 1});
  if (!unknown.empty())
    run.warn("metrics: the first run has found no " + unknown + " (" + study.metrics_place + ")");
}

void throw_if_unknown_metric(const Study& study, const std::vector<ChildRun>& runs) {
  const std::string unknown = unknown_metric(study, runs);
  if (!unknown.empty())
    throw Error::invalid_input("metrics: no run has found " + unknown +
                               "; the runs are kept, and --collect tabulates them again")
        .with_origin(study.metrics_place)
        .with_key("metrics", "");
}

// Throws for an unknown metric before anything is touched, if every run is already complete.
void check_known_metrics(const Study& study, std::vector<ChildRun> runs) {
  if (study.metrics.empty()) return;
  for (ChildRun& column : runs) {
    if (!load_cached_run(column)) return;
    drop_scene(column);
  }
  throw_if_unknown_metric(study, runs);
}

void run_all(Run& run, const Study& study, std::vector<ChildRun>& runs, const SweepJobs& jobs) {
  const auto stage = run.stage("runs");
  Progress progress(run, runs.size());
  bool none_complete = true;
  ColumnWarnings warnings;
  for (const ChildRun& column : runs) run.add_part(column.folder, jobs.resume);
  run_columns(
      runs, jobs,
      [&](ChildRun& column) {
        progress.ended(column);
        if (column.stopped.empty() && std::exchange(none_complete, false))
          warn_of_unknown_metric(run, study, column);
        warnings.add(column);
        drop_scene(column);
      },
      [&](const std::string& line) { progress.running(line); });
  run.keep_from_here();
  warnings.emit(run);
  progress.stop();
  progress.note(run, processes_at_once(runs, jobs));
}

void collect(Run& run, std::vector<ChildRun>& runs) {
  std::size_t failed = 0;
  ColumnWarnings warnings;
  for (ChildRun& column : runs) {
    load_outcome(column);
    warnings.add(column);
    drop_scene(column);
    if (!column.stopped.empty()) ++failed;
  }
  warnings.emit(run);
  run.metric("runs_count", runs.size());
  run.metric("failed_count", failed);
}

bool is_not_complete(const ChildRun& run) { return !run.stopped.empty(); }

// Writes tables, plots and page; the manifest of a study is incomplete if runs are missing.
void write_results(Run& run, const Study& study, const std::vector<ChildRun>& runs, bool with_plots) {
  table_of_runs(study, runs).write(run.path("table.csv"));
  const std::vector<std::string> metrics = metrics_shown(study, runs);
  const bool repeated = std::any_of(study.axes.begin(), study.axes.end(), is_seed);
  if (repeated && !metrics.empty()) table_of_means(study, runs, metrics).write(run.path("means.csv"));
  if (with_plots) plot_study(run, study, runs, metrics);
  if (std::ranges::any_of(runs, is_not_complete))
    finish_incomplete_with_report(run);
  else
    finish_with_report(run);
}

// Throws if runs are missing, which gives exit code 3 with the first reason.
void throw_if_failed(const Run& run, const std::vector<ChildRun>& runs) {
  const auto count = std::ranges::count_if(runs, is_not_complete);
  if (count == 0) return;
  const ChildRun& first = *std::ranges::find_if(runs, is_not_complete);
  throw Error::simulation(fmt::format("{} of {} runs are not complete ({}), the first {}: {}", count,
                                      runs.size(), (run.folder() / "table.csv").string(), first.name,
                                      first.stopped));
}

// Returns the runs that --only or --part selects.
std::vector<ChildRun> chosen(const std::vector<ChildRun>& runs, const SweepParams& choice) {
  std::vector<ChildRun> some;
  if (!choice.only.empty()) {
    std::copy_if(runs.begin(), runs.end(), std::back_inserter(some),
                 [&](const ChildRun& column) { return column.name == choice.only; });
    if (some.empty())
      throw Error::invalid_input("no run is called " + choice.only + " (--only)")
          .with_key("only", choice.only);
    return some;
  }
  const std::size_t slash = std::min(choice.part.find('/'), choice.part.size());
  const double k = number_in(choice.part.substr(0, slash)).value_or(0);
  const double n = number_in(choice.part.substr(std::min(slash + 1, choice.part.size()))).value_or(0);
  const auto all = static_cast<double>(runs.size());
  if (!(k >= 1 && k <= n && n <= all) || k != std::floor(k) || n != std::floor(n))
    throw Error::invalid_input(fmt::format("part = {} must be K/N with integers 1 <= K <= N <= {} (--part)",
                                           choice.part, runs.size()))
        .with_key("part", choice.part);
  const auto end = [&](double part) {
    return runs.begin() + static_cast<std::ptrdiff_t>(std::ceil(all * part / n));
  };
  return {end(k - 1), end(k)};
}

// Runs a part of the study without its common files, beside other such processes.  A run that is refused or
// cannot go on would do so in another attempt, too; a failing machine ends this part.
int run_some(std::vector<ChildRun> runs, const SweepParams& choice, bool quiet) {
  for (const ChildRun& column : runs)
    if (std::filesystem::is_directory(column.folder)) const FolderLock free(column.folder);
  run_columns(
      runs, sweep_jobs(choice, runs),
      [&](const ChildRun& column) {
        if (!quiet) std::cerr << column.name << ": " << run_outcome(column) << std::endl;
      },
      [](const std::string&) {});
  const auto failed = std::find_if(runs.begin(), runs.end(), [](const ChildRun& column) {
    return !column.stopped.empty() && column.exit_code != 2 && column.exit_code != kCouldNotGoOn;
  });
  if (failed != runs.end()) throw Error::system(failed->name + ": " + failed->stopped);
  return 0;
}

int run_sweep(const CommandLine& line) {
  if (line.positionals.size() != 1)
    throw Error::invalid_input("needs one study: a file, or a name in assets/studies");
  SweepParams choice;
  Options options;
  set_keys(line, option_keys(choice, options));
  const Study study = read_study(line.positionals[0]);
  if (options.out.empty())
    options.out = "out/sweep-" + std::filesystem::path(line.positionals[0]).stem().string();
  std::vector<ChildRun> runs = study_columns(study, options.out);
  check_batch(runs, choice.batch);
  if (!choice.snakemake.empty()) {
    write_study(choice, study, options.out);
    return 0;
  }
  if (!choice.only.empty() || !choice.part.empty())
    return run_some(chosen(runs, choice), choice, options.quiet);
  check_known_metrics(study, runs);
  Run run(line, options, study_record(study));
  run.path("table.csv");
  run.reserve({"means.csv"});
  if (choice.collect)
    collect(run, runs);
  else
    run_all(run, study, runs, sweep_jobs(choice, runs));
  write_results(run, study, runs, !options.no_images);
  throw_if_failed(run, runs);
  throw_if_unknown_metric(study, runs);
  return 0;
}

}  // namespace

Experiment sweep() {
  return {.name = "sweep",
          .question = "an experiment over the axes of a study: one table, curves, maps",
          .run = run_sweep,
          .own_keys = own_keys,
          .positionals = "STUDY",
          // The flags that distribute a study's runs over a machine go with any of these modes.
          .conditions = {{"resume", "not collect and not only and not part"},
                         {"resume | collect | only | part", "not snakemake"},
                         {"part", "not only"},
                         {"collect", "not only and not part"}},
          .headlines = {.all = {{"runs_count", "runs", "", "{:.0f}", 1, kNoErrors},
                                {"failed_count", "of them not complete", "", "{:.0f}", 1, kNoErrors}}}};
}

}  // namespace hysteron::experiments
