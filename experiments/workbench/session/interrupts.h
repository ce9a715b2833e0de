// SIGINT and SIGTERM as a question that the run asks itself between two instants.
#pragma once

#include <csignal>
#include <string>

namespace hysteron::experiments {

// While it lives, the first of these signals is kept; a second one ends the process as it always does, unless
// it comes within half a second: `timeout` and batch systems signal a process and its group.
class Interrupts {
 public:
  Interrupts();
  ~Interrupts();
  Interrupts(const Interrupts&) = delete;
  Interrupts& operator=(const Interrupts&) = delete;

  // "SIGTERM"; "" while none has come.
  std::string seen() const;

 private:
  struct sigaction interrupt_before_, terminate_before_;
};

}  // namespace hysteron::experiments
