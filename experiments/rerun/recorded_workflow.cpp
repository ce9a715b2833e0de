#include "experiments/rerun/recorded_workflow.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>

#include "experiments/workbench/app/json_file.h"
#include "experiments/workbench/app/manifest_file.h"
#include "experiments/workbench/app/recorded_command.h"
#include "sim/base/error.h"

namespace hysteron::experiments {
namespace {
namespace fs = std::filesystem;

constexpr double kMinutes = 60;  // [s]
constexpr double kSlack = 4;     // of other machines, and of a GPU's work on a CPU
constexpr int kMinMinutes = 30;
constexpr double kMegabyte = 1e6;
constexpr int kMinMemory = 1000;  // [MB]

// Manifests below, in the order of their names; of a run's folder its own alone.
std::vector<fs::path> manifests_below(const fs::path& folder) {
  std::set<fs::path> found;
  std::error_code failure;
  for (auto entry = fs::recursive_directory_iterator(folder, failure);
       entry != fs::recursive_directory_iterator(); entry.increment(failure)) {
    const fs::path& path = entry->path();
    if (entry->is_directory() && has_manifest(path)) {
      found.insert(path / "manifest.json");
      entry.disable_recursion_pending();
    } else if (path.extension() == ".json" && is_manifest(json_or_none(path))) {
      found.insert(path);
    }
  }
  if (failure) throw Error::system("cannot read the folder " + folder.string() + ": " + failure.message());
  if (found.empty()) throw Error::invalid_input("there is no manifest in " + folder.string() + " or below");
  return {found.begin(), found.end()};
}

// "crease-laws", "scenes/hanging-square-half".
std::string workflow_name(const fs::path& manifest, const fs::path& folder) {
  fs::path name = fs::relative(manifest, folder).replace_extension();
  return (name.filename() == "manifest" ? name.parent_path() : name).generic_string();
}

// Why it cannot be repeated; "" if it can.
std::string why_left_out(const RecordedRun& run, const CommandLine& line) {
  if (!run.manifest.complete) return "is not complete";
  for (const Flag& flag : line.flags)
    if (flag.text.ends_with(".csv") && !fs::exists(flag.text))
      return "needs " + flag.text + ", which is not here";
  return "";
}

// On a GPU, or a page of runs one of which was.
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

}  // namespace

RecordedWorkflow workflow_of_runs(const fs::path& folder, const fs::path& out,
                                  const std::vector<Flag>& flags) {
  const fs::path target = fs::absolute(out).lexically_normal();
  RecordedWorkflow all{
      {.out = out, .jobs = {}, .product = "index.html", .collects = {"report", target.string()}}, {}};
  for (const fs::path& file : manifests_below(folder)) {
    const std::string name = workflow_name(file, folder);
    try {
      const RecordedRun run = recorded_run(file.string());
      const CommandLine line = line_that_repeats(run);
      if (const std::string why = why_left_out(run, line); !why.empty()) {
        all.left_out.push_back(name + " " + why);
        continue;
      }
      std::vector<std::string> words = {"rerun",   fs::absolute(file).lexically_normal().string(),
                                        "--out",   (target / name).string(),
                                        "--quiet", "--threads=" + std::string(kThreads)};
      for (const Flag& flag : flags)
        if (flag.path != "threads") words.push_back("--" + flag.path + "=" + flag.text);
      all.workflow.jobs.push_back({name, words, job_resources(run, line, flags)});
    } catch (const Error& error) {
      all.left_out.push_back(name + ": " + error.what());
    }
  }
  return all;
}

}  // namespace hysteron::experiments
