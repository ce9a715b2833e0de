// This header has what a run in a folder of its own needs.
#pragma once

#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "experiments/workbench/app/experiment.h"
#include "experiments/workbench/app/json_file.h"
#include "experiments/workbench/app/run.h"
#include "experiments/workbench/session/driver.h"
#include "gtest/gtest.h"
#include "tests/sim/base/folder.h"
#include "tests/sim/base/refusal.h"
#include "tests/sim/base/small_disk.h"

namespace hysteron::experiments {
namespace fs = std::filesystem;

// In a test body `Run` is testing::Test::Run.
using ExperimentRun = Run;

using test::file_content;
using test::Folder;
using test::says;

inline int occurrences(const std::string& text, const std::string& part) {
  int count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

// Reads the manifest that a run has written into its folder.
inline Json manifest_in(const fs::path& run) { return read_json(run / "manifest.json"); }
inline Json metrics_of(const fs::path& run) { return manifest_in(run)["metrics"]; }

inline std::string out_flag(const fs::path& out) { return " --out " + out.string(); }

// The exit code of an experiment with these flags, which writes into `out` without pictures and progress.
inline int run_into(const fs::path& out, const std::string& experiment, std::vector<Flag> flags) {
  flags.insert(flags.end(), {{"out", out.string()}, {"no-images", true}, {"quiet", true}});
  return run_experiment({experiment, "hysteron " + experiment, std::move(flags), {}});
}
// Metrics of such a run, which ends well.
inline Json metrics_with(const std::string& experiment, std::vector<Flag> flags) {
  const Folder folder;
  EXPECT_EQ(run_into(folder.path(), experiment, std::move(flags)), 0);
  return metrics_of(folder.path());
}

// The process works in a folder while this object exists.
class InFolder {
 public:
  explicit InFolder(const fs::path& folder) { fs::current_path(folder); }
  ~InFolder() { fs::current_path(before_); }
  InFolder(const InFolder&) = delete;
  InFolder& operator=(const InFolder&) = delete;

 private:
  const fs::path before_ = fs::current_path();
};

inline Setup setup_in(const fs::path& out) {
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
