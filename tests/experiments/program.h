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

// What is said on stderr beside warnings.
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

}  // namespace hysteron::experiments
