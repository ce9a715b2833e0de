// Runs many small simulations at once.
#pragma once

#include <functional>

namespace hysteron {

// Calls job(i) for i in [0, count), each of which makes simulations of its own and advances them.  On a GPU
// the jobs take turns: while one of them waits the next goes on, and loops that several have ordered are
// launched once for all of them, so that many small cloths fill a GPU that each by itself would leave idle.
// On a CPU they come one after the other.  Every simulation gets the same bits as alone.  Throws a job's
// exception when all have ended; Error::system without a GPU.
void run_batched_scenes(bool on_gpu, int count, const std::function<void(int)>& job);

// Returns how many jobs share the GPU's launches with the one that the calling thread runs, itself included:
// wall-clock times and launch counts are then those of all of them. 1: none.
int jobs_together();

}  // namespace hysteron
