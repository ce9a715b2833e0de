// Files that appear under their name only when they are whole.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>

namespace hysteron::render {

// A name beside `path`, of this process and call only, for a file that is renamed to `path` when it is whole.
std::filesystem::path temporary_beside(const std::filesystem::path& path);

// Renames; Error::machine, with the temporary file removed, if that fails.
void rename_into_place(const std::filesystem::path& temporary, const std::filesystem::path& path);

// Writes all bytes and renames.  Error::machine names the path and the system's reason (no space, no permission);
// then neither `path` nor the temporary file is left.
void write_atomically(const std::filesystem::path& path, std::span<const std::uint8_t> bytes);

}  // namespace hysteron::render
