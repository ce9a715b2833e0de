// How a command line ends, in whatever way.
#pragma once

#include <functional>
#include <string>

namespace hysteron::experiments {

struct Ending {
  int exit_code = 0;
  std::string error{};  // its line on stderr; "": none
};

// What `body` returns or throws.  The error names the experiment, which `body` may set before it throws:
// "hysteron drape: fabric.b2 = -1 N m must be >= 0 (drape.toml:7)".
Ending run_ending(const std::string& experiment, const std::function<int()>& body);

}  // namespace hysteron::experiments
