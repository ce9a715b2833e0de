// What this machine computes and draws with, each of which was opened to see that it can be.
#pragma once

#include <string>
#include <vector>

namespace hysteron::experiments {

struct TriedDevice {
  std::string kind;     // cpu, cuda, renderer
  std::string id;       // "cuda:0", "EGL device 0"
  std::string name;     // with driver and version, as manifests have it; "EGL device 0 fails", "none"
  std::string failure;  // why it could not be; empty: it was
};

// The CPU, all GPUs, all renderers in the order in which they are tried for pictures.
std::vector<TriedDevice> tried_devices();

}  // namespace hysteron::experiments
