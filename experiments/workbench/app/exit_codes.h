// What the program's exit code says, once for --help and documentation.
#pragma once

namespace hysteron::experiments {

inline constexpr int kMachineFailed = 1;
inline constexpr int kCouldNotGoOn = 3;  // those below it: sim/base/error.h
inline constexpr int kDiffers = 4;

struct ExitCode {
  int code;
  const char* meaning;
};
// Those that every subcommand has.
inline constexpr ExitCode kExitCodes[] = {
    {0, "done"},
    {kMachineFailed, "the machine failed (file, disk, GPU, renderer)"},
    {2, "the request is wrong"},
    {kCouldNotGoOn, "the run could not go on; what was written so far is kept and marked incomplete"}};

}  // namespace hysteron::experiments
