// Runs functions that take turns on one thread.
#pragma once

#include <functional>
#include <memory>
#include <vector>

namespace hysteron {

// Each job has a stack of its own and runs until it waits or ends, then the next one does.  Each job also has
// its own copy of the thread's state: this program's device_counts, and C++'s exceptions that are being
// handled.
class Fibers {
 public:
  Fibers();
  ~Fibers();
  Fibers(const Fibers&) = delete;
  Fibers& operator=(const Fibers&) = delete;

  // Runs job(i) for i in [0, count) to their ends.  Whenever all that have not ended wait, and once more when
  // all have ended, it calls all_wait() and lets them go on.  After all have ended it throws the first
  // exception of a job; an exception of all_wait() is thrown in each job that waits.
  void run(int count, const std::function<void(int)>& job, const std::function<void()>& all_wait);
  // Makes the job that calls it wait.
  void wait();
  int current() const { return current_; }  // -1: none runs

 private:
  struct Fiber;
  static void begin();
  void resume_fiber(Fiber& fiber);
  void switch_to_caller(Fiber& fiber);

  std::vector<std::unique_ptr<Fiber>> fiber_;
  const std::function<void(int)>* job_ = nullptr;
  std::exception_ptr failure_;  // an exception of all_wait()
  int current_ = -1;
};

}  // namespace hysteron
