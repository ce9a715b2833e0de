// Runs independent pieces of work on several threads.
#pragma once

#include <atomic>
#include <cstddef>
#include <future>
#include <vector>

#include "sim/base/job.h"

namespace hysteron {

// Calls body(i) for i in [0, n), in this order but `threads` at a time.  An exception of a body ends its
// thread and is thrown again when the others are done.
template <class Body>
void in_parallel(std::size_t n, int threads, const Body& body) {
  std::atomic<std::size_t> next = 0;
  Job* const job = Job::current();
  const auto work = [&] {
    const WorkingFor working(job);
    for (std::size_t i = next++; i < n; i = next++) body(i);
  };
  std::vector<std::future<void>> workers;
  for (int t = 0; t < threads; ++t) workers.push_back(std::async(std::launch::async, work));
  for (auto& worker : workers) worker.wait();
  for (auto& worker : workers) worker.get();
}

}  // namespace hysteron
