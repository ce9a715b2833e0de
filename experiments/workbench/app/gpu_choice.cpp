#include "experiments/workbench/app/gpu_choice.h"

#include <cstdlib>

#include "sim/base/comma_list.h"
#include "sim/base/error.h"
#include "sim/device/visible_gpus.h"

namespace hysteron::experiments {
namespace {

constexpr std::string_view kGpu = "cuda:";
constexpr std::size_t kMaxDigits = 4;

std::vector<std::string> allowed_gpus() {
  const char* allowed = std::getenv(kVisibleGpus);
  return split(allowed ? allowed : "");
}

}  // namespace

std::string visible_gpu(int gpu) {
  const std::vector<std::string> names = allowed_gpus();
  return gpu < static_cast<int>(names.size()) ? names[gpu] : std::to_string(gpu);
}

void choose_gpu(CommandLine& line, int of_machine, bool with_cuda) {
  for (Flag& flag : line.flags) {
    const std::string device = flag.text();
    if (flag.path != "device" || !device.starts_with(kGpu)) continue;
    const auto refuse = [&](const std::string& why) {
      throw Error::invalid_input("--device " + device + ": " + why)
          .with_key("device", "")
          .with_experiment(line.experiment);
    };
    const std::string number = device.substr(kGpu.size());
    if (number.empty() || number.size() > kMaxDigits || number.find_first_not_of("0123456789") != number.npos)
      refuse("after cuda: comes the number of a GPU, from 0 on");
    if (!with_cuda) {
      flag.value = "cuda";
      continue;
    }
    const int gpu = std::stoi(number), allowed = static_cast<int>(allowed_gpus().size());
    if (allowed > 0 && gpu >= allowed)
      refuse(std::string(kVisibleGpus) + " = " + std::getenv(kVisibleGpus) + " leaves " + gpus_text(allowed));
    if (allowed == 0 && of_machine > 0 && gpu >= of_machine)
      refuse("this machine has " + gpus_text(of_machine));
    setenv(kVisibleGpus, visible_gpu(gpu).c_str(), 1);
    flag.value = "cuda";
  }
}

bool may_use_gpu(const CommandLine& line) {
  const Experiment& experiment = experiment_named(line.experiment);
  if (!experiment.simulates) return false;
  const bool cpu = experiment.defaults && experiment.defaults().scene.device == DeviceChoice::cpu;
  return last_text(line.flags, "device", cpu ? "cpu" : "auto") != "cpu";
}

}  // namespace hysteron::experiments
