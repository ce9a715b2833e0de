// Checkpoints of a session: what is in them, when they are taken, how a run goes on from one.
#include <fmt/core.h>

#include <iostream>
#include <nlohmann/json.hpp>

#include "experiments/workbench/app/manifest_file.h"
#include "experiments/workbench/pages/closing_words.h"
#include "experiments/workbench/session/checkpoint.h"
#include "experiments/workbench/session/interrupts.h"
#include "experiments/workbench/session/session.h"
#include "sim/base/fnv1a.h"
#include "sim/base/whole_file.h"
#include "sim/scene/keys.h"

namespace hysteron::experiments {
namespace {
namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr const char* kFile = "checkpoint";

// Without what no result depends on: threads, and where values come from.
std::string comparable(Json scene) {
  for (const char* key : {"threads", "origin"}) scene.erase(key);
  if (scene.contains("fabric") && scene["fabric"].is_object()) scene["fabric"].erase("provenance");
  return scene.dump();
}

std::uint64_t hash_of(const Cloth& cloth) {
  std::uint64_t hash = kFnv1aStart;
  for (const auto& face : cloth.mesh.face) hash = fnv1a(face.data(), sizeof(int) * 3, hash);
  if (cloth.mesh.sewn)
    for (const auto& corners : cloth.mesh.panel)
      for (const Eigen::Vector2d& x : corners) hash = fnv1a(x.data(), 2 * sizeof(double), hash);
  for (const auto* points : {&cloth.mesh.rest, &cloth.start})
    for (const Eigen::Vector3d& x : *points) hash = fnv1a(x.data(), 3 * sizeof(double), hash);
  return fnv1a(cloth.pin.data(), cloth.pin.size() * sizeof cloth.pin[0], hash);
}

CheckpointOwner owner_of(const CommandLine& line, const Setup& setup, const Cloth& cloth,
                         const Simulation& simulation) {
  return {program_version(), line.experiment, simulation.device(), comparable(to_json(setup.scene)),
          setup.choices,     hash_of(cloth)};
}

}  // namespace

// A run that is complete is not repeated; of one that is not, its checkpoint is read.
void Session::check_existing_run() {
  const fs::path folder = setup_.options.out;
  const std::optional<Manifest> before = manifest_or_none(folder / "manifest.json");
  if (before && before->complete) {
    const std::string keys = differing_keys(comparable(before->keys ? *before->keys : Json::object()),
                                            comparable(to_json(setup_.scene)));
    if (before->experiment != line_.experiment || !keys.empty())
      throw Error::invalid_input(folder.string() + " has a complete run of other values" +
                                 (keys.empty() ? "" : " (" + keys + ")") + ": give another folder (--out)")
          .of("resume", folder.string());
    is_complete_ = true;
    if (setup_.options.json)
      std::cout << whole_file(folder / "manifest.json", "cannot read the manifest") << std::flush;
    else if (!setup_.options.quiet)
      std::cerr << folder.string() << " is complete" << std::endl;
    return;
  }
  if (const auto state = read_checkpoint(folder / kFile, owner_of(line_, setup_, cloth_, *simulation_)))
    state_ = *state;
}

// Of what the interrupted run has written; its other files are written anew.
std::vector<std::string> Session::kept_files() const {
  if (state_.empty()) return {};
  std::vector<std::string> files, kept = {kFile};
  Archive archive{state_};
  archive(files);
  for (const std::string& name : files)
    if (is_numbered(name) || name == kKeptFrames || name.starts_with("mesh/cloth.")) kept.push_back(name);
  return kept;
}

bool Session::takes_checkpoints(const RunPlan& question) const {
  const Options& options = setup_.options;
  if (options.checkpoint <= 0 && !options.resume) return false;
  if (!question.visit)
    throw Error::invalid_input("--checkpoint and --resume: not built yet for " + line_.experiment);
  return options.checkpoint > 0;
}

void Session::visit(Archive& archive, const RunPlan& question, Record& series) {
  run_->visit(archive);  // files first: kept_files()
  archive(resumed_at_);
  archive(folded_);
  archive(stretched_);
  if (crossings_) crossings_->visit(archive);
  meshes_.visit(archive);
  recoveries_.visit(archive);
  series.visit(archive);
  probes_.visit(archive);
  if (pictures_) pictures_->visit(archive, *run_);
  question.visit(archive);
  std::string state;
  if (!archive.loads()) state = simulation_->save();
  archive(state);
  if (archive.loads()) simulation_->load(state);
}

// Says whether the run goes on from a checkpoint.
bool Session::go_on(const RunPlan& question, Record& series) {
  if (state_.empty()) {
    if (setup_.options.resume)
      run_->progress("no checkpoint in " + run_->folder().string() + ": from the start");
    return false;
  }
  Archive archive{state_};
  visit(archive, question, series);
  state_ = {};
  resumed_at_.push_back(simulation_->time());
  run_->note("resumed_at_s", resumed_at_);
  run_->progress(fmt::format("goes on from the checkpoint at t = {:.4f} s", simulation_->time()));
  return true;
}

void Session::take_checkpoint(const RunPlan& question, Record& series) {
  const auto stage = run_->stage("io");
  const fs::path file = run_->path(kFile);
  Archive archive;
  visit(archive, question, series);
  write_checkpoint(file, owner_of(line_, setup_, cloth_, *simulation_), archive.take());
  checkpoint_taken_ = Clock::now();
}

// Between two instants: a checkpoint if one is due.  Throws Error::simulation where a signal has asked for
// the end.
void Session::pause(const RunPlan& question, Record& series, const Interrupts& interrupts) {
  const std::string signal = interrupts.seen();
  const double since = std::chrono::duration<double>(Clock::now() - checkpoint_taken_).count();
  if (!signal.empty() || since >= setup_.options.checkpoint) take_checkpoint(question, series);
  if (!signal.empty())
    throw Error::simulation(
        fmt::format("{} at t = {:.4f} s: the same command with --resume goes on from there", signal,
                    simulation_->time()));
}

void Session::drop_checkpoint() {
  if (setup_.options.checkpoint > 0 || setup_.options.resume) run_->forget(kFile);
}

}  // namespace hysteron::experiments
