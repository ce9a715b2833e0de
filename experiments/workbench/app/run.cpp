#include "experiments/workbench/app/run.h"

#include <algorithm>
#include <ctime>
#include <iostream>

#include "experiments/workbench/app/version.h"
#include "sim/base/atomic_file.h"
#include "sim/base/error.h"

namespace hysteron::experiments {
namespace {
namespace fs = std::filesystem;

const char* const kStages[] = {"membrane", "bending", "solve",  "contact",
                               "history",  "render",  "encode", "io"};

std::string utc_now() {
  const std::time_t now = std::time(nullptr);
  std::tm parts{};
  gmtime_r(&now, &parts);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &parts);
  return text;
}

// What is known at the start, in the order in which the manifest shows it.
Json first_entries(const CommandLine& line, const Json& scene) {
  Json entries;
  entries["hysteron"] = {{"version", kVersion}, {"commit", kGitCommit}, {"dirty", kGitDirty}};
  entries["experiment"] = line.experiment;
  entries["command"] = line.command;
  entries["started"] = utc_now();
  entries["scene"] = scene;
  for (const char* key : {"device", "renderer", "positions"}) entries[key] = nullptr;
  for (const char* key : {"precision", "element", "law"}) entries[key] = scene.value(key, Json());
  for (const char* key : {"triangles", "hinges", "steps", "seconds_simulated"}) entries[key] = nullptr;
  entries["wall_seconds"] = nullptr;
  for (const char* key : {"bytes_device", "energy", "state_hash"}) entries[key] = nullptr;
  return entries;
}

struct FirstRun {
  bool started = false;
  fs::path folder;
};

FirstRun& first_run() {
  static FirstRun run;
  return run;
}

void remember_first(const fs::path& folder, bool json) {
  if (!first_run().started && !json) first_run().folder = folder;
  first_run().started = true;
}

}  // namespace

std::string program_version() {
  return std::string(kVersion) + " (commit " + kGitCommit + (kGitDirty ? ", modified)" : ")");
}

Run::Run(const CommandLine& line, const Setup& setup) : Run(line, setup.options, to_json(setup.scene)) {}

Run::Run(const CommandLine& line, const Options& options, const Json& keys)
    : folder_(options.out, line),
      json_(options.json),
      quiet_(options.quiet),
      entries_(first_entries(line, keys)) {
  remember_first(folder(), json_);
  write_manifest(false);
}

Run::~Run() {
  if (finished_) return;
  try {
    write_manifest(false);
  } catch (const Error& error) {
    // The exception that ended the run is on its way; this one can only be mentioned.
    std::cerr << "hysteron: " << error.what() << std::endl;
  }
}

const fs::path& Run::first_folder() { return first_run().folder; }

fs::path Run::path(const std::string& name) {
  if (std::count(files_.begin(), files_.end(), name)) return folder() / name;
  const fs::path file = folder_.place_for(name), relative = name;
  files_.push_back(name);
  const bool is_new =
      known_.insert(is_numbered(relative) ? relative.parent_path() / relative.extension() : relative).second;
  if (is_new && !finished_) write_manifest(false);
  return file;
}

void Run::forget(const std::string& name) {
  std::error_code ignored;
  if (std::erase(files_, name) > 0) fs::remove(folder() / name, ignored);
}

void Run::note(const std::string& key, Json value) { entries_[key] = std::move(value); }

void Run::metric(const std::string& name, Json value) { metrics_[name] = std::move(value); }

void Run::energy(const std::vector<std::pair<std::string, double>>& terms) {
  entries_["energy"] = Json::object();
  for (const auto& [name, joules] : terms) entries_["energy"][name] = joules;
}

void Run::add_seconds(const std::string& stage, double seconds) { seconds_[stage] += seconds; }

void Run::plot(const std::string& name, const std::function<void(const fs::path&)>& draw) {
  const Stage stage(*this, "render");
  for (const char* ending : {".png", ".svg"}) path(name + ending);
  try {
    draw(folder() / name);
  } catch (const Error& error) {
    for (const char* ending : {".png", ".svg"}) forget(name + ending);
    entries_["plots_missing"].push_back(name + ": " + error.what());
    progress(name + ": " + error.what());
  }
}

void Run::progress(const std::string& line) const {
  if (!quiet_) std::cerr << line << std::endl;
}

Json Run::manifest(bool complete) const {
  Json all = entries_;
  Json& seconds = all["wall_seconds"];
  seconds["total"] = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  for (const char* stage : kStages) seconds[stage] = 0.0;
  for (const auto& [stage, spent] : seconds_) seconds[stage] = spent;
  all["metrics"] = metrics_;
  all["files"] = files_;
  all["complete"] = complete;
  return all;
}

void Run::write_manifest(bool complete) const {
  AtomicFile file((folder() / "manifest.json").string());
  file.stream() << manifest(complete).dump(2) << "\n";
  file.commit();
}

void Run::finish() {
  write_manifest(true);
  finished_ = true;
  if (json_) std::cout << manifest(true).dump(2) << std::endl;
}

}  // namespace hysteron::experiments
