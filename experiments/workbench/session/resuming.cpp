#include "experiments/workbench/session/resuming.h"

#include <fmt/core.h>

#include <iostream>
#include <nlohmann/json.hpp>

#include "experiments/workbench/app/manifest_file.h"
#include "experiments/workbench/app/same_request.h"
#include "experiments/workbench/app/this_program.h"
#include "experiments/workbench/pages/manifest.h"
#include "experiments/workbench/session/checkpoint.h"
#include "experiments/workbench/session/interrupts.h"
#include "sim/base/fnv1a.h"
#include "sim/base/whole_file.h"

namespace hysteron::experiments {
namespace {
namespace fs = std::filesystem;

constexpr const char* kFile = "checkpoint";

std::uint64_t cloth_hash(const Cloth& cloth) {
  std::uint64_t hash = kFnv1aStart;
  for (const auto& face : cloth.mesh.face) hash = fnv1a(face.data(), sizeof(int) * 3, hash);
  if (cloth.mesh.sewn)
    for (const auto& corners : cloth.mesh.panel)
      for (const Eigen::Vector2d& x : corners) hash = fnv1a(x.data(), 2 * sizeof(double), hash);
  for (const auto* points : {&cloth.mesh.rest, &cloth.start})
    for (const Eigen::Vector3d& x : *points) hash = fnv1a(x.data(), 3 * sizeof(double), hash);
  return fnv1a(cloth.pin.data(), cloth.pin.size() * sizeof cloth.pin[0], hash);
}

CheckpointOwner checkpoint_owner(const Cloth& cloth, const Simulation& simulation) {
  return {simulation.device(), cloth_hash(cloth)};
}

// Throws unless the run that left the checkpoint is this one, by its manifest.
void throw_if_another(const fs::path& file, const std::optional<Manifest>& before, const CommandLine& line,
                      const Setup& setup) {
  if (!before) refuse_checkpoint(file, "there is no manifest.json beside it");
  if (const std::string program = program_change(*before); !program.empty()) refuse_checkpoint(file, program);
  if (before->experiment != line.experiment)
    refuse_checkpoint(file, "its experiment is " + before->experiment + ", not " + line.experiment);
  const std::string keys = changed_keys(*before, setup);
  if (!keys.empty()) refuse_checkpoint(file, "other values of " + keys);
  const std::vector<std::string> files = input_changes(before->inputs, inputs_of_job(file.parent_path()));
  if (!files.empty()) refuse_checkpoint(file, joined(files, ", "));
}

}  // namespace

Checkpoints::Checkpoints(const CommandLine& line, const Setup& setup, const Cloth& cloth,
                         const Simulation& simulation) {
  const Options& options = setup.options;
  if (!options.resume) return;
  const fs::path folder = options.out;
  const std::optional<Manifest> before = manifest_or_none(folder / "manifest.json");
  if (!before || !before->complete) {
    const auto state = read_checkpoint(folder / kFile, checkpoint_owner(cloth, simulation));
    if (!state) return;
    throw_if_another(folder / kFile, before, line, setup);
    state_ = *state;
    return;
  }
  const std::string why = why_another_request(*before, line, setup);
  if (!why.empty()) {
    if (!options.quiet)
      std::cerr << folder.string() << " is complete, but " << why << ": from the start" << std::endl;
    is_repeated_ = true;
    return;
  }
  is_complete_ = true;
  if (options.json)
    std::cout << whole_file(folder / "manifest.json", "cannot read the manifest") << std::flush;
  else if (!options.quiet)
    std::cerr << folder.string() << " is complete" << std::endl;
}

std::vector<std::string> Checkpoints::archived_files() const {
  if (state_.empty()) return {};
  std::vector<std::string> files, kept = {kFile};
  Archive archive{state_};
  archive(files);
  for (const std::string& name : files)
    if (is_numbered(name) || name == kArchivedFrames || name.starts_with("mesh/cloth.")) kept.push_back(name);
  return kept;
}

void Checkpoints::begin(Session& session) {
  const Options& options = session.setup().options;
  if (options.checkpoint <= 0 && !options.resume) return;
  Run& run = session.run();
  if (state_.empty()) {
    if (options.resume && !is_repeated_)
      run.progress("no checkpoint in " + run.folder().string() + ": from the start");
    return;
  }
  Archive archive{state_};
  session.serialise(archive);
  state_ = {};
  const double time = session.simulation().time();
  resumed_at_.push_back(time);
  run.note("resumed_at_s", resumed_at_);
  run.progress(fmt::format("goes on from the checkpoint at t = {:.4f} s", time));
}

void Checkpoints::take(Session& session) {
  const auto stage = session.run().stage("io");
  const fs::path file = session.run().path(kFile);
  Archive archive;
  session.serialise(archive);
  write_checkpoint(file, checkpoint_owner(session.cloth(), session.simulation()), archive.take());
  taken_ = Clock::now();
}

void Checkpoints::step(Session& session) {
  const double interval = session.setup().options.checkpoint;
  if (interval <= 0) return;
  const std::string signal = Interrupts::seen();
  if (!signal.empty() || std::chrono::duration<double>(Clock::now() - taken_).count() >= interval)
    take(session);
  if (!signal.empty())
    throw Error::simulation(
        fmt::format("{} at t = {:.4f} s: the same command with --resume goes on from there", signal,
                    session.simulation().time()));
}

void Checkpoints::finish(Session& session, const std::string&) {
  const Options& options = session.setup().options;
  if (options.checkpoint > 0 || options.resume) session.run().forget(kFile);
}

}  // namespace hysteron::experiments
