// What the program's exit code says, once for --help, manual and documentation.
#pragma once

#include <string>

namespace hysteron::experiments {

inline constexpr int kCouldNotGoOn = 3;  // those below it: sim/base/error.h
inline constexpr int kDiffers = 4;

struct ExitCode {
  int code;
  const char* meaning;
};
// Those that every subcommand has.
inline constexpr ExitCode kExitCodes[] = {
    {0, "done"},
    {1, "the machine failed (file, disk, GPU, renderer)"},
    {2, "the request is wrong"},
    {kCouldNotGoOn, "the run could not go on; what was written so far is kept and marked incomplete"}};

// A line for each of them and, unless it is "", for what 4 says.
inline std::string exit_codes_text(const std::string& differs) {
  std::string text = "Exit codes:";
  const auto add = [&](int code, const std::string& meaning) {
    text += "\n  " + std::to_string(code) + "  " + meaning;
  };
  for (const ExitCode& exit : kExitCodes) add(exit.code, exit.meaning);
  if (!differs.empty()) add(kDiffers, differs);
  return text;
}

}  // namespace hysteron::experiments
