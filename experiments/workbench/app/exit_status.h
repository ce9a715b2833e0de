// Converts the end of a command line, normal or not, to an exit code.
#pragma once

#include <functional>
#include <string>

namespace hysteron::experiments {

inline constexpr int kMachineFailed = 1;
inline constexpr int kRefused = 2;
inline constexpr int kCouldNotGoOn = 3;  // lower exit codes: sim/base/error.h
inline constexpr int kDiffers = 4;

struct ExitCode {
  int code;
  const char* meaning;
};
// The exit codes that every subcommand has.
inline constexpr ExitCode kExitCodes[] = {
    {0, "done"},
    {kMachineFailed, "the machine failed (file, disk, GPU, renderer)"},
    {kRefused, "the request is wrong"},
    {kCouldNotGoOn, "the run could not go on; what was written so far is kept and marked incomplete"}};

struct ExitStatus {
  int exit_code = 0;
  std::string error{};  // the line for stderr; "" if there is none
};

// Runs `body`, a job (sim/base/job.h), and returns what it returns or throws.  The error names the
// experiment, which `body` may set before it throws: "hysteron drape: fabric.b2 = -1 N m must be >= 0
// (drape.toml:7)".
ExitStatus run_guarded(const std::string& experiment, const std::function<int()>& body);

}  // namespace hysteron::experiments
