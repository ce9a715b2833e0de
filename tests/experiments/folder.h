// A folder of its own for each test, and what a run in it needs.
#pragma once

#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "experiments/workbench/app/run.h"
#include "gtest/gtest.h"
#include "tests/sim/base/small_disk.h"

namespace hysteron::experiments {

// In a test body `Run` is testing::Test::Run.
using ExperimentRun = Run;

class Folder {
 public:
  Folder() {
    static int count = 0;
    path_ = std::filesystem::path(testing::TempDir()) /
            ("hysteron-run-" + std::to_string(getpid()) + "-" + std::to_string(count++));
    std::filesystem::create_directories(path_);
  }
  ~Folder() { std::filesystem::remove_all(path_); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

inline std::string file_text(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

inline int occurrences(const std::string& text, const std::string& part) {
  int count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

inline std::string out_flag(const std::filesystem::path& out) { return " --out " + out.string(); }

inline Setup setup_in(const std::filesystem::path& out) {
  Setup setup{default_scene(), {}};
  setup.options.out = out.string();
  setup.options.quiet = true;
  return setup;
}

inline CommandLine drape_line() { return {"drape", "hysteron drape --quick", {}, {}}; }

// Exit code of `body` in a child process that may not write more than `bytes` into any file: a disk that is
// full before the file is.
template <class Body>
int on_a_disk_with(rlim_t bytes, Body body) {
  const pid_t child = fork();
  if (child == 0) {
    const test::SmallDisk disk(bytes);
    _exit(body());
  }
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

}  // namespace hysteron::experiments
