// Tells users about GPUs that a run cannot use.
#pragma once

#include <filesystem>
#include <string>

namespace hysteron {

inline constexpr const char* kVisibleGpus = "CUDA_VISIBLE_DEVICES";

// Was this program built with CUDA? If not, it does not read CUDA_VISIBLE_DEVICES.  Defined beside
// gpu_count() (sim/time/back_end.h).
bool is_built_with_cuda();

// Returns the number of NVIDIA GPUs for which the system has device files, without asking CUDA, which reads
// CUDA_VISIBLE_DEVICES once and for all.
int gpus_of_machine(const std::filesystem::path& devices = "/dev");

// Lists GPUs: "1 GPU, cuda:0", "4 GPUs, cuda:0 to cuda:3".
std::string gpus_text(int count);

// Completes CUDA's reason for finding no GPU by how many the machine has and the effect of
// CUDA_VISIBLE_DEVICES (null: not set): "no CUDA-capable device is detected: CUDA_VISIBLE_DEVICES = 3, and
// this machine has 1 GPU, cuda:0".
std::string no_gpu_message(const std::string& reason, int of_machine, const char* visible);
// Completes the reason for this machine and process; without CUDA it stays as it is.
std::string no_gpu_message(const std::string& reason);

}  // namespace hysteron
