// Columns as processes of this program: by themselves, or several in one.
#pragma once

#include "experiments/workbench/compare/sweep_columns.h"

namespace hysteron::experiments {

// Columns that share a process, by their places.
using Chunk = std::vector<std::size_t>;

// In the order of the columns, `largest` in each or what is left.  Those of a chunk name the same device, and
// all of them or none take checkpoints; the column `first` is by itself.
std::vector<Chunk> batch_chunks(const std::vector<ChildRun>& columns, int largest, int first);

// What a process gets of the machine.
struct ProcessShare {
  int threads = 1;
  int gpu = -1;  // -1: none of its own
};

// Runs the columns of the chunk in one process and takes from each what it has left; `ended` is called with
// its place.  A run that fails leaves the others alone: the errors of run_columns() are thrown after their
// end.
void run_chunk(std::vector<ChildRun>& columns, const Chunk& chunk, const SweepJobs& jobs,
               ProcessShare process_share, const std::function<void(std::size_t)>& ended);

}  // namespace hysteron::experiments
