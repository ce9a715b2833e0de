#include "sim/time/together.h"

#include <algorithm>
#include <atomic>

#include "sim/base/parallel.h"
#include "sim/time/back_end.h"

namespace hysteron {
namespace {

thread_local int members_here = 1;

}  // namespace

void run_together(bool on_gpu, int count, int threads, const std::function<void(int)>& job) {
  if (count <= 0) return;
  const int shares = std::clamp(threads, 1, count);
  if (!on_gpu) return in_parallel(count, shares, [&](std::size_t i) { job(static_cast<int>(i)); });
  in_parallel(shares, shares, [&](std::size_t share) {
    const int first = static_cast<int>(share);
    const int members = (count - first + shares - 1) / shares;
    members_here = members;  // of a thread that ends with this share
    run_on_gpu_together(members, [&](int member) { job(first + member * shares); });
  });
}

void run_together_by(int most, int count, int threads, const std::function<void(int)>& job) {
  std::atomic<int> next = 0;
  run_together(true, std::min(most, count), threads, [&](int) {
    for (int i = next++; i < count; i = next++) job(i);
  });
}

int jobs_together() { return members_here; }

}  // namespace hysteron
