// The one exception type: every failure is a single line for the user and an exit code for scripts.
#pragma once

#include <stdexcept>
#include <string>

namespace hysteron {

// Thrown wherever the program cannot do what was asked.  The message is one line: what was attempted, the
// value with its unit, the file and line where it stands, what is allowed or what to do.
class Error : public std::runtime_error {
 public:
  // The machine failed (file, disk, GPU, renderer): exit code 1.
  static Error machine(const std::string& message) { return Error(1, message); }
  // The request is wrong (unknown key, wrong type, out of range, impossible mesh): exit code 2.
  static Error request(const std::string& message) { return Error(2, message); }
  // The run could not go on (no convergence, no feasible state): exit code 3.
  static Error run(const std::string& message) { return Error(3, message); }

  int exit_code() const { return exit_code_; }

 private:
  Error(int exit_code, const std::string& message) : std::runtime_error(message), exit_code_(exit_code) {}
  int exit_code_;
};

}  // namespace hysteron
