// What is read of the files that a user names, and what such files may contain.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace hysteron::fuzz {

struct Format {
  std::string name;                                                        // and ending of its seeds
  std::vector<std::string> words;                                          // see Mutation
  std::vector<std::function<void(const std::filesystem::path&)>> readers;  // each may throw an Error
  std::function<std::string(std::string)> repaired = nullptr;  // what half of the files go through first
};

const std::vector<Format>& formats();

}  // namespace hysteron::fuzz
