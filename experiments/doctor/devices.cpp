#include "experiments/doctor/findings.h"

#include <nlohmann/json.hpp>

#include "render/contexts.h"
#include "render/offscreen.h"
#include "sim/base/error.h"
#include "sim/base/process.h"
#include "sim/device/visible_gpus.h"
#include "sim/time/back_end.h"

namespace hysteron::experiments {
namespace {

constexpr unsigned kLongestForGpus = 60;  // time [s] in which a driver starts eight sleeping GPUs

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

std::vector<TriedDevice> gpus() {
  std::vector<TriedDevice> devices;
  std::string reason;
  const int count = gpu_count(reason);
  for (int i = 0; i < count; ++i)
    devices.push_back(tried("cuda", "cuda:" + std::to_string(i), [i] { return gpu_description(i); }));
  if (count == 0) devices.push_back({"cuda", "cuda", "none", no_gpu_message(reason)});
  return devices;
}

// Encodes the devices as JSON, because a child process can return only a text.
std::string text_of(const std::vector<TriedDevice>& devices) {
  Json list = Json::array();
  for (const TriedDevice& device : devices)
    list.push_back({device.kind, device.id, device.name, device.failure});
  return list.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::vector<TriedDevice> devices_in(const std::string& text) {
  std::vector<TriedDevice> devices;
  for (const Json& device : Json::parse(text))
    devices.push_back({device[0], device[1], device[2], device[3]});
  return devices;
}

void append(std::vector<TriedDevice>& devices, const std::vector<TriedDevice>& more) {
  devices.insert(devices.end(), more.begin(), more.end());
}

std::vector<TriedDevice> tried_gpus() {
  try {
    return devices_in(answer_of_child([] { return text_of(gpus()); }, kLongestForGpus));
  } catch (const Error& error) {
    return {{"cuda", "cuda", "CUDA fails", error.what()}};
  }
}

// Tries the devices of EGL, which is also asked in a child, as listing its devices loads its drivers.
std::vector<TriedDevice> tried_egl() {
  std::vector<TriedDevice> devices;
  std::size_t count = 0;
  try {
    const std::string answer = answer_of_child([]() -> std::string {
      const std::size_t candidates = render::egl_candidates().size();
      return candidates > 0 ? std::to_string(candidates) : render::egl_unavailable();
    });
    count = answer.find_first_not_of("0123456789") == answer.npos ? std::stoul(answer) : 0;
    if (count == 0) devices.push_back({"renderer", "EGL", "EGL fails", answer});
  } catch (const Error& error) {
    devices.push_back({"renderer", "EGL", "EGL fails", error.what()});
  }
  const auto candidate = [](std::size_t i) {
    return render::Offscreen::candidates(render::Renderer::egl).at(i);
  };
  for (std::size_t i = 0; i < count; ++i) {
    const auto name = [&] { return answer_of_child([&] { return candidate(i).name(); }); };
    const TriedDevice named = tried("renderer", "EGL", name);
    devices.push_back(tried("renderer", named.name, [&] {
      return answer_of_child([&] { return render::Offscreen::create(candidate(i))->description(); });
    }));
  }
  return devices;
}

TriedDevice tried_osmesa() {
  const render::Candidate osmesa{.kind = render::Candidate::Kind::osmesa};
  return tried("renderer", osmesa.name(), [&] {
    return answer_of_child([&] { return render::Offscreen::create(osmesa)->description(); });
  });
}

}  // namespace

std::vector<TriedDevice> tried_devices() {
  std::vector<TriedDevice> devices = {{"cpu", "cpu", cpu_description(), ""}};
  append(devices, tried_gpus());
  append(devices, tried_egl());
  devices.push_back(tried_osmesa());
  return devices;
}

Json devices_json(const std::vector<TriedDevice>& devices) {
  Json list = Json::array();
  for (const TriedDevice& device : devices) {
    Json entry = {{device.kind == "renderer" ? "renderer" : "device", device.id},
                  {"name", device.failure.empty() ? Json(device.name) : Json(nullptr)}};
    if (!device.failure.empty()) entry["reason"] = device.failure;
    list.push_back(entry);
  }
  return list;
}

}  // namespace hysteron::experiments
