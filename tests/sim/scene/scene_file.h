// Scene and fabric files for the tests of reading, in a folder of their own.
#pragma once

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "gtest/gtest.h"
#include "sim/base/error.h"

namespace hysteron {

class TextFile {
 public:
  explicit TextFile(const std::string& text, const std::string& ending = ".toml") {
    static int count = 0;
    path_ = std::filesystem::path(testing::TempDir()) /
            ("hysteron-" + std::to_string(getpid()) + "-" + std::to_string(count++) + ending);
    std::ofstream(path_) << text;
  }
  ~TextFile() { std::filesystem::remove(path_); }
  TextFile(const TextFile&) = delete;
  TextFile& operator=(const TextFile&) = delete;

  std::string path() const { return path_.string(); }
  // "file.toml:3"
  std::string line(int number) const { return path() + ":" + std::to_string(number); }

 private:
  std::filesystem::path path_;
};

struct Failure {
  int exit_code = 0;
  std::string message;
};

// Exit code and line of what `attempt` throws; {0, ""} if it does not.
template <class Attempt>
Failure caught_failure(Attempt attempt) {
  try {
    attempt();
  } catch (const Error& error) {
    return {error.exit_code(), error.what()};
  }
  return {};
}

}  // namespace hysteron
