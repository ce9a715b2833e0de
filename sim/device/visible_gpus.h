// What a user is told about GPUs that a run cannot have.
#pragma once

#include <filesystem>
#include <string>

namespace hysteron {

inline constexpr const char* kVisibleGpus = "CUDA_VISIBLE_DEVICES";

// Whether this program was built with CUDA; one that was not reads no CUDA_VISIBLE_DEVICES.  Defined beside
// gpu_count() (sim/time/back_end.h).
bool is_built_with_cuda();

// NVIDIA GPUs that the system has device files of, without asking CUDA, which reads CUDA_VISIBLE_DEVICES once
// and for all; 0 where there are none, or none of that kind.
int gpus_of_machine(const std::filesystem::path& devices = "/dev");

// "1 GPU, cuda:0", "4 GPUs, cuda:0 to cuda:3"
std::string gpus_text(int count);

// CUDA's reason for finding no GPU, with how many the machine has and what CUDA_VISIBLE_DEVICES (null: not
// set) makes of them: "no CUDA-capable device is detected: CUDA_VISIBLE_DEVICES = 3, and this machine has 1
// GPU, cuda:0".
std::string no_gpu_message(const std::string& reason, int of_machine, const char* visible);
// The same of this machine and process; the reason alone of a program without CUDA.
std::string no_gpu_message(const std::string& reason);

}  // namespace hysteron
