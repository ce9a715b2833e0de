#include "sim/time/together.h"

#include "sim/base/parallel.h"
#include "sim/time/back_end.h"

namespace hysteron {
namespace {

thread_local int members_here = 1;

}  // namespace

void run_batched_scenes(bool on_gpu, int count, const std::function<void(int)>& job) {
  if (count <= 0) return;
  if (!on_gpu) return in_parallel(count, 1, [&](std::size_t i) { job(static_cast<int>(i)); });
  in_parallel(1, 1, [&](std::size_t) {
    members_here = count;  // this thread ends with them
    run_on_gpu_together(count, job);
  });
}

int jobs_together() { return members_here; }

}  // namespace hysteron
