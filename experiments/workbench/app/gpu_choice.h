// Chooses one of several GPUs for a run, among those that CUDA_VISIBLE_DEVICES leaves, counted from 0.
#pragma once

#include <string>

#include "experiments/workbench/app/command_line.h"
#include "sim/device/visible_gpus.h"

namespace hysteron::experiments {

// Returns CUDA's name of that GPU among those that this process may use.
std::string visible_gpu(int gpu);

// Turns `--device cuda:N` into `cuda`, and lets this process and those that it starts see GPU N alone.  It
// must be called before anything asks for GPUs.  Throws Error::invalid_input if CUDA_VISIBLE_DEVICES or,
// without it, the machine has fewer (0: unknown); in a program without CUDA the simulation reports the
// missing device.
void choose_gpu(CommandLine& line, int of_machine = gpus_of_machine(), bool with_cuda = is_built_with_cuda());

// True if the line simulates, and neither its --device nor its experiment names the CPU.
bool may_use_gpu(const CommandLine& line);

}  // namespace hysteron::experiments
