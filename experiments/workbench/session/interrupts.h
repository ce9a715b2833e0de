// SIGINT and SIGTERM as a question that the run asks itself between two instants.
#pragma once

#include <string>

namespace hysteron::experiments {

// While one of them lives, the first of these signals is kept, for all of them; a second one ends the process
// as it always does, unless it comes within half a second: `timeout` and batch systems signal a process and
// its group.  They come and go on one thread at a time.
class Interrupts {
 public:
  Interrupts();
  ~Interrupts();
  Interrupts(const Interrupts&) = delete;
  Interrupts& operator=(const Interrupts&) = delete;

  // "SIGTERM"; "" while none has come.
  static std::string seen();
};

}  // namespace hysteron::experiments
