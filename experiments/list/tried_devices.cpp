#include "experiments/list/tried_devices.h"

#include "render/contexts.h"
#include "render/offscreen.h"
#include "sim/base/error.h"
#include "sim/time/back_end.h"

namespace hysteron::experiments {
namespace {

template <class Open>
TriedDevice tried(const std::string& kind, const std::string& id, const Open& open) {
  constexpr int kAttempts = 2;  // drivers fail now and then while another process starts
  TriedDevice device{kind, id, id + " fails", ""};
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    try {
      device.name = open();
      device.failure.clear();
      return device;
    } catch (const Error& error) {
      device.failure = error.what();
    }
  }
  return device;
}

void try_gpus(std::vector<TriedDevice>& devices) {
  std::string reason;
  const int gpus = gpu_count(reason);
  for (int i = 0; i < gpus; ++i)
    devices.push_back(tried("cuda", "cuda:" + std::to_string(i), [i] { return gpu_description(i); }));
  if (gpus == 0) devices.push_back({"cuda", "cuda", "none", reason});
}

void try_renderers(std::vector<TriedDevice>& devices) {
  using render::Offscreen;
  const std::vector<render::Candidate> all = Offscreen::candidates(render::Renderer::automatic);
  if (render::egl_candidates().empty())
    devices.push_back({"renderer", "EGL", "EGL fails", render::egl_unavailable()});
  for (const render::Candidate& candidate : all)
    devices.push_back(
        tried("renderer", candidate.name(), [&] { return Offscreen::create(candidate)->description(); }));
}

}  // namespace

std::vector<TriedDevice> tried_devices() {
  std::vector<TriedDevice> devices = {{"cpu", "cpu", cpu_description(), ""}};
  try_gpus(devices);
  try_renderers(devices);
  return devices;
}

}  // namespace hysteron::experiments
