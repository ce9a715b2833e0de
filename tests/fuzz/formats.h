// These formats are those of the files that a user names.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace hysteron::fuzz {

struct Format {
  std::string name, seeds;                                                 // and of the folder of its seeds
  std::string ending;                                                      // of its files, ".obj"
  std::vector<std::function<void(const std::filesystem::path&)>> readers;  // each may throw an Error
  std::function<std::string(std::string)> repaired = nullptr;  // with check sums of what is there now
};

// Returns OBJ, PLY, PC2, MDD, TOML, CSV, PNG, manifests and checkpoints.
std::vector<Format> formats();
// Returns what a page shows of a manifest, and of a table beside one.
std::vector<Format> pages();

// Returns how many of the readers took it, the others having refused it by an Error of one line.  Throws what
// anything else threw.
int taken(const Format& format, const std::filesystem::path& file);

}  // namespace hysteron::fuzz
