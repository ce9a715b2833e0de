// OUT/checkpoint holds a simulated run at one of its recorded instants, from which the same command goes on
// (--resume).
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace hysteron::experiments {

// The conditions for a run to go on, beside those in its folder's manifest.
struct CheckpointOwner {
  std::string device;
  std::uint64_t cloth = 0;  // hash of triangles and start, as meshes may come from files
};

// Replaces the file atomically.  Throws Error::system.
void write_checkpoint(const std::filesystem::path& file, CheckpointOwner owner, const std::string& state);

// Returns the written state; nothing if there is no file.  Throws Error::invalid_input, in one line, for a
// file that is not this program's, is cut off or damaged, or has another owner, naming the difference.
std::optional<std::string> read_checkpoint(const std::filesystem::path& file, const CheckpointOwner& owner);

// Throws Error::invalid_input: "cannot resume from OUT/checkpoint: WHY; without --resume ...".
[[noreturn]] void refuse_checkpoint(const std::filesystem::path& file, const std::string& why);

}  // namespace hysteron::experiments
