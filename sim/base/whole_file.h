// Reads every file that a user names, and enters it in the job of the thread (job.h).
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

namespace hysteron {

// The most that image libraries can count
inline constexpr std::size_t kMaxBytes = (std::size_t{1} << 31) - 1;

// Returns the bytes of a regular file; pipes and devices, which may never end, are not opened.  Throws
// Error::system, "ATTEMPT: reason", if it cannot be read, Error::invalid_input if it is larger than `most`.
std::string whole_file(const std::filesystem::path& file, const std::string& attempt,
                       std::size_t most = kMaxBytes);
// Reads the same where the name is part of a request: every failure is Error::invalid_input.
std::string file_named(const std::filesystem::path& file, const std::string& attempt);

}  // namespace hysteron
