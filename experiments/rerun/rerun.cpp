// A run once more, exactly as its manifest has it.
#include <fmt/core.h>

#include <algorithm>
#include <iostream>

#include "experiments/rerun/recorded_workflow.h"
#include "experiments/workbench/app/gpu_choice.h"
#include "experiments/workbench/app/json_file.h"
#include "experiments/workbench/app/manifest_file.h"
#include "experiments/workbench/app/recorded_command.h"
#include "experiments/workbench/app/run.h"
#include "experiments/workbench/pages/report.h"
#include "sim/base/atomic_file.h"
#include "sim/base/error.h"

namespace hysteron::experiments {
namespace {
namespace fs = std::filesystem;

struct RerunChoice {
  bool no_errors = false;
  std::string snakemake;
};
using R = RerunChoice;
// clang-format off
const KeyRow<R> kRows[] = {
    {"no-errors", at<&R::no_errors>, "", any(), "", "without the repeats of --errors"},
    {"snakemake", at<&R::snakemake>, "", any(), "", "folder: write all runs below DIR as a Snakemake workflow there, and run nothing"},
};
// clang-format on

// Where it runs is not part of what it computes: on one device every number of threads has the same bits.
std::vector<KeyDescription> device_keys() {
  std::vector<KeyDescription> keys = scene_keys();
  std::erase_if(keys,
                [](const KeyDescription& key) { return key.path != "device" && key.path != "threads"; });
  for (KeyDescription& key : keys) key.default_text = "";
  return keys;
}

std::vector<KeyDescription> own_keys() {
  RerunChoice choice;
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

// A warning of a run that is over: said, and kept in its manifest and on its page.
void add_warning(const fs::path& folder, const std::string& text) {
  std::cerr << "warning: " << text << std::endl;
  const fs::path file = folder / "manifest.json";
  Json manifest = read_json(file);
  manifest["warnings"].push_back(text);
  write_text(file, manifest.dump(2) + "\n");
  if (fs::exists(folder / "report.html")) write_report(folder);
}

// "state 70f23134675a1e81, as recorded"
void say_outcome(const Manifest& before, const fs::path& folder, bool quiet) {
  const std::optional<Manifest> now = manifest_or_none(folder / "manifest.json");
  if (!now || !now->state_hash || !before.state_hash) return;
  if (now->state_hash != before.state_hash)
    add_warning(folder, "state " + *now->state_hash + " differs from the recorded " + *before.state_hash +
                            ": `hysteron verify` tells in what");
  else if (!quiet)
    std::cerr << "state " << *now->state_hash << ", as recorded" << std::endl;
}

// Of all runs below a folder, with what the line asks of each.
int write_runs(const CommandLine& line, const std::string& flow) {
  const fs::path folder = line.positionals.front();
  std::vector<Flag> flags = line.flags;
  std::erase_if(flags, [](const Flag& flag) {
    return flag.path == "out" || flag.path == "snakemake" || flag.path == "quiet" || flag.path == "json";
  });
  const std::string name = fs::absolute(folder / "").lexically_normal().parent_path().filename().string();
  const RecordedWorkflow all =
      workflow_of_runs(folder, last_text(line.flags, "out", "out/rerun-" + name), flags);
  write_workflow(flow, all.workflow);
  const auto on_gpus = std::count_if(all.workflow.jobs.begin(), all.workflow.jobs.end(),
                                     [](const WorkflowJob& job) { return job.resources.gpus > 0; });
  for (const std::string& words : all.left_out) std::cout << "left out: " << words << "\n";
  std::cout << fmt::format("{} runs, {} of them on a GPU: {}\n", all.workflow.jobs.size(), on_gpus,
                           starting_words(flow));
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
  const int exit_code = experiment_named(repeated.experiment).run(repeated);
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
