// Which of several GPUs a run takes: those that CUDA_VISIBLE_DEVICES leaves, counted from 0.
#pragma once

#include <string>

#include "experiments/workbench/app/command_line.h"
#include "sim/device/visible_gpus.h"

namespace hysteron::experiments {

// What CUDA calls that GPU among those that this process is allowed.
std::string visible_gpu(int gpu);

// `--device cuda:N` becomes `cuda`, for which this process and those that it starts see GPU N alone.  To be
// called before anything asks for GPUs.  Error::invalid_input where CUDA_VISIBLE_DEVICES or, without it, the
// machine has fewer (0: it is not known how many); a program without CUDA leaves it to what simulates to say
// that it has none.
void choose_gpu(CommandLine& line, int of_machine = gpus_of_machine(), bool with_cuda = is_built_with_cuda());

// The line simulates, and its --device or its experiment's own does not name the CPU.
bool may_use_gpu(const CommandLine& line);

}  // namespace hysteron::experiments
