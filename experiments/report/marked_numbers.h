// Numbers in Markdown that programs write: each stands between two comments, which render as nothing.
//
//   opens to <!-- n: results/crease-cotton-broad recovery_angle_deg .1f° +-.1g -->127.8° ± 0.1<!-- /n -->
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace hysteron::experiments {

// A number that is not what its folder says.
struct StaleNumber {
  std::filesystem::path file;
  int line = 0;
  std::string expected, found;
};

// README.md and docs/*.md beside a folder of results, their numbers from below it (number_source.h) compared
// with what it says now; the order is that of files and lines.  Numbers from elsewhere are passed over.
// Throws Error::request, "docs/validation.md:12: ...", if a marker is wrong or its number is not there.
std::vector<StaleNumber> stale_numbers(const std::filesystem::path& results);

// Writes them as they are now, and returns the files that changed.  Throws Error::machine if one cannot be
// written.
std::vector<std::filesystem::path> write_numbers(const std::filesystem::path& results);

}  // namespace hysteron::experiments
