// Another program run without a shell.
#pragma once

#include <string>
#include <vector>

namespace hysteron {

struct ProcessResult {
  bool started = false;
  int exit_code = -1;            // -1 if it was not started or a signal ended it
  std::string first_error_line;  // of what it wrote to stderr that is not blank
};

// Runs `words` (the first is searched in PATH), writes `input` to its stdin and waits.  What it writes to
// stdout is dropped.  The program gets SIGTERM when this one is killed.
ProcessResult run_process(const std::vector<std::string>& words, const std::string& input);

}  // namespace hysteron
