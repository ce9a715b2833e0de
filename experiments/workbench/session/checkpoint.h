// OUT/checkpoint: a simulated run at one of its recorded instants, from which the same command goes on
// (--resume).
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace hysteron::experiments {

// What must be the same where a run goes on, beside what the manifest in its folder says of it.
struct CheckpointOwner {
  std::string device;
  std::uint64_t cloth = 0;  // hash of triangles and start: meshes may come from files
};

// Replaces the file atomically.  Throws Error::system.
void write_checkpoint(const std::filesystem::path& file, CheckpointOwner owner, const std::string& state);

// The state that was written; nothing where there is no file.  Throws Error::invalid_input, in one line, for
// a file that is not one of this program's, is cut off or damaged, or whose owner is another: what differs is
// named.
std::optional<std::string> read_checkpoint(const std::filesystem::path& file, const CheckpointOwner& owner);

// Throws Error::invalid_input: "cannot resume from OUT/checkpoint: WHY; without --resume ...".
[[noreturn]] void refuse_checkpoint(const std::filesystem::path& file, const std::string& why);

}  // namespace hysteron::experiments
