// `hysteron rerun` repeats a run exactly as its manifest describes it.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <optional>
#include <set>

#include "experiments/workbench/app/gpu_choice.h"
#include "experiments/workbench/app/json_file.h"
#include "experiments/workbench/app/manifest_file.h"
#include "experiments/workbench/app/recorded_command.h"
#include "experiments/workbench/app/run.h"
#include "experiments/workbench/app/same_request.h"
#include "experiments/workbench/app/set_aside.h"
#include "experiments/workbench/compare/workflow.h"
#include "experiments/workbench/pages/report.h"
#include "experiments/workbench/session/driver.h"
#include "sim/base/atomic_file.h"
#include "sim/base/error.h"
#include "sim/base/whole_file.h"

namespace hysteron::experiments {
namespace {
namespace fs = std::filesystem;

struct RerunParams {
  bool no_errors = false;
  std::string snakemake;
};
using R = RerunParams;
// clang-format off
const KeyRow<R> kRows[] = {
    {"no-errors", at<&R::no_errors>, "", any(), "without the repeats of --errors"},
    {"snakemake", at<&R::snakemake>, "", any(), "folder: write all runs below DIR as a Snakemake workflow there, and run nothing"},
};
// clang-format on

// Returns the keys of the device, which do not change the results: on one device every number of threads
// gives the same bits.
std::vector<KeyDescription> device_keys() {
  std::vector<KeyDescription> keys = scene_keys();
  std::erase_if(keys, [](const KeyDescription& key) { return key.traits.scope != Scope::run; });
  for (KeyDescription& key : keys) key.default_text = "";
  return keys;
}

std::vector<KeyDescription> own_keys() {
  RerunParams choice;
  Options options;
  std::vector<KeyDescription> keys = descriptions(with_output_options(bind(kRows, choice), options));
  std::erase_if(keys, [](const KeyDescription& key) { return key.path == "quick"; });
  for (const KeyDescription& key : device_keys()) keys.push_back(key);
  return keys;
}

std::string folder_for(const RecordedRun& run) {
  const std::string name = fs::absolute(run.file).lexically_normal().parent_path().filename().string();
  return "out/rerun-" + (name.empty() ? run.manifest.experiment : name);
}

// Adds a warning to a finished run: on stderr, in its manifest and on its page.
void add_warning(const fs::path& folder, const std::string& text) {
  std::cerr << "warning: " << text << std::endl;
  const fs::path file = folder / "manifest.json";
  Json manifest = read_json(file);
  manifest["warnings"].push_back(text);
  write_text(file, manifest.dump(2) + "\n");
  if (fs::exists(folder / "report.html")) write_report(folder);
}

// Prints "state 70f23134675a1e81, as recorded".
void say_outcome(const Manifest& before, const fs::path& folder, bool quiet) {
  const std::optional<Manifest> now = manifest_or_none(folder / "manifest.json");
  if (!now || !now->state_hash || !before.state_hash) return;
  if (now->state_hash != before.state_hash)
    add_warning(folder, "state " + *now->state_hash + " differs from the recorded " + *before.state_hash +
                            ": `hysteron verify` tells in what");
  else if (!quiet)
    std::cerr << "state " << *now->state_hash << ", as recorded" << std::endl;
}

// Reports changed inputs.  The manifest of a simulated run holds its scene and fabric; other runs read their
// files as they are now.
void say_inputs(const Manifest& before, const fs::path& folder) {
  if (before.options || !has_manifest(folder)) return;
  for (const std::string& change : input_changes(before.inputs))
    add_warning(folder, change + " since the recorded run, and is read as it is now");
}

constexpr double kMinutes = 60;  // least time limit [s]
constexpr double kSlack = 4;     // allowance for other machines, and for a GPU's work on a CPU
constexpr int kMinMinutes = 30;
constexpr double kMegabyte = 1e6;
constexpr int kMinMemory = 1000;  // [MB]

// Returns the manifests below, in the order of their names; for a run's folder only its own.
std::vector<fs::path> manifests_below(const fs::path& folder) {
  std::set<fs::path> found;
  std::error_code failure;
  for (auto entry = fs::recursive_directory_iterator(folder, failure);
       entry != fs::recursive_directory_iterator(); entry.increment(failure)) {
    const fs::path& path = entry->path();
    if (is_set_aside(path)) {
      entry.disable_recursion_pending();
    } else if (entry->is_directory() && has_manifest(path)) {
      found.insert(path / "manifest.json");
      entry.disable_recursion_pending();
    } else if (path.extension() == ".json" && is_manifest(json_or_none(path))) {
      found.insert(path);
    }
  }
  if (failure) throw unreadable(folder, failure);
  if (found.empty()) throw Error::invalid_input("there is no manifest in " + folder.string() + " or below");
  return {found.begin(), found.end()};
}

// Returns "crease-laws", "scenes/hanging-square-half".
std::string workflow_name(const fs::path& manifest, const fs::path& folder) {
  fs::path name = fs::relative(manifest, folder).replace_extension();
  return (name.filename() == "manifest" ? name.parent_path() : name).generic_string();
}

// Returns why a run cannot be repeated, or "" if it can.
std::string why_left_out(const RecordedRun& run, const CommandLine& line) {
  if (!run.manifest.complete) return "is not complete";
  const std::string input = missing_input(line);
  return input.empty() ? "" : "needs " + input + ", which is not here";
}

// True if the run was on a GPU, or is a page of runs one of which was.
bool had_gpu(const RecordedRun& run, const CommandLine& line) {
  if (last_text(line.flags, "device", "").starts_with("cuda")) return true;
  if (run.manifest.device) return run.manifest.device->starts_with("cuda");
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(run.file.parent_path(), ignored)) {
    const auto column = manifest_or_none(entry.path() / "manifest.json");
    if (column && column->device && column->device->starts_with("cuda")) return true;
  }
  return false;
}

JobResources job_resources(const RecordedRun& run, const CommandLine& line, const std::vector<Flag>& flags) {
  JobResources resources;
  const std::string recorded = last_text(line.flags, "threads", "1");
  resources.cores = std::max(1, std::atoi(last_text(flags, "threads", recorded).c_str()));
  resources.gpus = last_text(flags, "device", "").starts_with("cpu") ? 0 : had_gpu(run, line);
  const Manifest& m = run.manifest;
  resources.minutes =
      std::max(kMinMinutes, static_cast<int>(std::ceil(kSlack * m.total_seconds() / kMinutes)));
  const double bytes = m.bytes_device ? static_cast<double>(*m.bytes_device) : 0;
  resources.memory = kMinMemory + static_cast<int>(kSlack * bytes / kMegabyte);
  return resources;
}

// Returns a folder of recorded runs as a workflow that writes all of it anew, as results/ was written.  Every
// manifest below is a job, whatever its file's name; those inside another run's folder belong to it.
// OUT/NAME is the repetition of FOLDER/NAME, and OUT/index.html the page of all.  Runs ask for as many cores
// as they had, for a GPU if they had one, unless `flags` (of rerun: threads, device, ...) override that, and
// for four times as long as they took.  `left_out` receives a text for each run that cannot be repeated.
Workflow workflow_of_runs(const fs::path& folder, const fs::path& out, const std::vector<Flag>& flags,
                          std::vector<std::string>& left_out) {
  const fs::path target = fs::absolute(out).lexically_normal();
  Workflow workflow{.out = out, .jobs = {}, .product = "index.html", .collects = {"report", target.string()}};
  for (const fs::path& file : manifests_below(folder)) {
    const std::string name = workflow_name(file, folder);
    try {
      const RecordedRun run = recorded_run(file.string());
      const CommandLine line = line_that_repeats(run);
      if (const std::string why = why_left_out(run, line); !why.empty()) {
        left_out.push_back(name + " " + why);
        continue;
      }
      std::vector<std::string> words = {"rerun",   fs::absolute(file).lexically_normal().string(),
                                        "--out",   (target / name).string(),
                                        "--quiet", "--threads=" + std::string(kThreads)};
      for (const Flag& flag : flags)
        if (flag.path != "threads") words.push_back(flag.word());
      workflow.jobs.push_back({name, words, job_resources(run, line, flags)});
    } catch (const Error& error) {
      left_out.push_back(name + ": " + error.what());
    }
  }
  return workflow;
}

// Writes the workflow of all runs below a folder, with the flags of the line for each.
int write_runs(const CommandLine& line, const std::string& flow) {
  const fs::path folder = line.positionals.front();
  std::vector<Flag> flags = line.flags;
  std::erase_if(flags, [](const Flag& flag) {
    return flag.path == "out" || flag.path == "snakemake" || flag.path == "quiet" || flag.path == "json";
  });
  const std::string name = fs::absolute(folder / "").lexically_normal().parent_path().filename().string();
  std::vector<std::string> left_out;
  const Workflow workflow =
      workflow_of_runs(folder, last_text(line.flags, "out", "out/rerun-" + name), flags, left_out);
  write_workflow(flow, workflow);
  const auto on_gpus = std::count_if(workflow.jobs.begin(), workflow.jobs.end(),
                                     [](const WorkflowJob& job) { return job.resources.gpus > 0; });
  for (const std::string& words : left_out) std::cout << "left out: " << words << "\n";
  std::cout << fmt::format("{} runs, {} of them on a GPU: {}\n", workflow.jobs.size(), on_gpus,
                           starting_text(flow));
  return 0;
}

int run_rerun(const CommandLine& line) {
  if (line.positionals.size() != 1)
    throw Error::invalid_input("needs one run: its folder or its manifest.json");
  if (const std::string flow = last_text(line.flags, "snakemake", ""); !flow.empty())
    return write_runs(line, flow);
  const RecordedRun run = recorded_run(line.positionals.front());
  const std::string out = last_text(line.flags, "out", folder_for(run));
  std::vector<Flag> later = line.flags;
  std::erase_if(later, [](const Flag& flag) { return flag.path == "no-errors" || flag.path == "out"; });
  later.push_back({"out", out});
  CommandLine repeated = line_that_repeats(run, later, last_text(line.flags, "no-errors", "") != "true");
  choose_gpu(repeated);
  const int exit_code = run_experiment(repeated);
  say_inputs(run.manifest, out);
  say_outcome(run.manifest, out, last_text(line.flags, "quiet", "") == "true");
  return exit_code;
}

}  // namespace

Experiment rerun() {
  return {.name = "rerun",
          .question = "a run once more, exactly as its manifest has it",
          .run = run_rerun,
          .own_keys = own_keys,
          .positionals = "DIR|manifest.json"};
}

}  // namespace hysteron::experiments
