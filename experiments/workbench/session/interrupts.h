// Turns SIGINT and SIGTERM into a question that the run asks itself between two instants.
#pragma once

#include <string>

namespace hysteron::experiments {

// While an object lives, the first of these signals is stored, for all objects; a second one ends the process
// as usual, unless it comes within half a second, because `timeout` and batch systems signal a process and
// its group.  Objects are created and destroyed on one thread at a time.
class Interrupts {
 public:
  Interrupts();
  ~Interrupts();
  Interrupts(const Interrupts&) = delete;
  Interrupts& operator=(const Interrupts&) = delete;

  // Returns "SIGTERM"; "" until one has come.
  static std::string seen();
};

}  // namespace hysteron::experiments
