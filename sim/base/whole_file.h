// Reads every file that a user names, and enters it in the job of the thread (job.h).
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <system_error>

#include "sim/base/error.h"

namespace hysteron {

// The most that image libraries can count
inline constexpr std::size_t kMaxBytes = (std::size_t{1} << 31) - 1;

// Returns the bytes of a regular file; pipes and devices, which may never end, are not opened.  Throws
// Error::system, "ATTEMPT: reason", if it cannot be read, Error::invalid_input if it is larger than `most`.
std::string whole_file(const std::filesystem::path& file, const std::string& attempt,
                       std::size_t most = kMaxBytes);
// Reads the same; the attempt is "cannot read FILE".
std::string whole_file(const std::filesystem::path& file);
// Reads the same where the name is part of a request: every failure is Error::invalid_input.
std::string file_named(const std::filesystem::path& file, const std::string& attempt);

// Throws Error::invalid_input if there is neither a file nor a folder of that name.
void check_there(const std::filesystem::path& path);
// Returns the failure to go through a folder, for the reason that a directory iterator gives.
Error unreadable(const std::filesystem::path& folder, const std::error_code& reason);

}  // namespace hysteron
