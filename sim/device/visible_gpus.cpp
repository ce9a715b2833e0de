#include "sim/device/visible_gpus.h"

#include <cstdlib>

namespace hysteron {
namespace {

// Is true for "nvidia0", but not for "nvidiactl" or "nvidia-uvm".
bool names_a_gpu(const std::string& file) {
  const std::string kind = "nvidia";
  return file.size() > kind.size() && file.starts_with(kind) &&
         file.find_first_not_of("0123456789", kind.size()) == file.npos;
}

}  // namespace

int gpus_of_machine(const std::filesystem::path& devices) {
  int count = 0;
  std::error_code failure;
  for (std::filesystem::directory_iterator i(devices, failure), end; !failure && i != end;
       i.increment(failure))
    count += names_a_gpu(i->path().filename().string());
  return count;
}

std::string gpus_text(int count) {
  if (count == 1) return "1 GPU, cuda:0";
  return std::to_string(count) + " GPUs, cuda:0 to cuda:" + std::to_string(count - 1);
}

std::string no_gpu_message(const std::string& reason, int of_machine, const char* visible) {
  const std::string machine = of_machine > 0 ? "this machine has " + gpus_text(of_machine) : "";
  if (!visible) return reason + (machine.empty() ? "" : ": " + machine);
  return reason + ": " + kVisibleGpus + " = " + visible + (machine.empty() ? "" : ", and " + machine);
}

std::string no_gpu_message(const std::string& reason) {
  if (!is_built_with_cuda()) return reason;
  return no_gpu_message(reason, gpus_of_machine(), std::getenv(kVisibleGpus));
}

}  // namespace hysteron
