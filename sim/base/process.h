// Other processes: another program run without a shell, and a call that may crash.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace hysteron {

struct ProcessResult {
  bool started = false;
  int exit_code = -1;            // -1 if it was not started or a signal ended it
  std::string first_error_line;  // the first line on stderr that is neither blank nor a "warning: ..."
};

// Runs `words` (the first is searched in PATH), writes `input` to its stdin and waits.  `said`, which must
// not throw, is called with each whole line that it writes to stdout, as it comes; without it the lines are
// dropped.  The program gets SIGTERM when this one is killed.
ProcessResult run_process(const std::vector<std::string>& words, const std::string& input,
                          const std::function<void(const std::string&)>& said = {});

// Makes the call in a child process that writes nothing to stdout and stderr, waits, and returns the result.
// Throws Error::system if the call throws, or if a signal ends the child, as happens after `longest` seconds:
// "it ends by a signal (Segmentation fault)", "it takes longer than 10 s".
std::string answer_of_child(const std::function<std::string()>& call, unsigned longest = 10);

}  // namespace hysteron
