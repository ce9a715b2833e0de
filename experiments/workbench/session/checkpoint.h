// OUT/checkpoint: a simulated run at one of its recorded instants, from which the same command goes on
// (--resume).
#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

namespace hysteron::experiments {

// What must be the same where a run goes on.
struct CheckpointOwner {
  std::string program, experiment, device;
  nlohmann::ordered_json scene;     // resolved
  nlohmann::ordered_json resolved;  // keys of the run and the experiment that decide what is written
  std::uint64_t cloth = 0;          // hash of triangles and start: meshes may come from files
};

// "step, fabric.b2": paths of the keys whose values differ; at most a few of them, and how many more.
std::string differing_keys(const nlohmann::ordered_json& keys, const nlohmann::ordered_json& others);

// Replaces the file atomically.  Throws Error::system.
void write_checkpoint(const std::filesystem::path& file, CheckpointOwner owner, const std::string& state);

// The state that was written; nothing where there is no file.  Throws Error::invalid_input, in one line, for
// a file that is not one of this program's, is cut off or damaged, or whose owner is another: what differs is
// named.
std::optional<std::string> read_checkpoint(const std::filesystem::path& file, const CheckpointOwner& owner);

}  // namespace hysteron::experiments
