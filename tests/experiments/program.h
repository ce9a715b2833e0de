// The program as a script meets it.
#pragma once

#include <cstdlib>
#include <sstream>
#include <string>

#include "tests/experiments/folder.h"

namespace hysteron::experiments {

struct Outcome {
  int exit_code;
  std::string out, err;
};

// Returns the lines of stderr that are not warnings.
inline std::string without_warnings(const std::string& err) {
  std::istringstream lines(err);
  std::string remainder;
  for (std::string line; std::getline(lines, line);)
    if (!line.starts_with("warning: ")) remainder += line + "\n";
  return remainder;
}

// HYSTERON_PROGRAM is defined by the build.
inline Outcome program(const std::string& arguments) {
  const Folder folder;
  const std::string out = folder.path() / "out", err = folder.path() / "err";
  const int status = std::system((HYSTERON_PROGRAM " " + arguments + " >" + out + " 2>" + err).c_str());
  return {WEXITSTATUS(status), file_content(out), file_content(err)};
}

// The same with arguments that have to end in this exit code.
inline Outcome ended(int exit_code, const std::string& arguments) {
  Outcome outcome = program(arguments);
  EXPECT_EQ(outcome.exit_code, exit_code) << arguments << '\n' << outcome.out << outcome.err;
  return outcome;
}
inline Outcome finished(const std::string& arguments) { return ended(0, arguments); }
// Returns the program's message to arguments that it refuses as a wrong request.
inline std::string refused(const std::string& arguments) { return ended(2, arguments).err; }

// This struct is a run into a folder of its own, which must end well.
struct FinishedRun {
  explicit FinishedRun(const std::string& arguments) : outcome(finished(arguments + out_flag(out))) {}
  Json manifest() const { return manifest_in(out); }
  Json metrics() const { return metrics_of(out); }

  const Folder folder;
  const fs::path out = folder.path() / "out";
  const Outcome outcome;
};

// Starts the program by a shell, with redirections if need be; the number of its process.
inline pid_t started(const std::string& arguments) {
  const pid_t child = fork();
  if (child != 0) return child;
  execl("/bin/sh", "sh", "-c", ("exec " HYSTERON_PROGRAM " " + arguments).c_str(), nullptr);
  _exit(127);
}

}  // namespace hysteron::experiments
