// Profiles the time of a step loop by loop: calls, seconds and bytes by the names that loops carry.  A device
// whose `profile` is empty pays one branch per loop.
#pragma once

#include <chrono>
#include <cstddef>
#include <map>
#include <string>

namespace hysteron {

// A loop's name in profiles and errors, and the least number of bytes that it must move: every array that it
// reads once and every one that it writes once; 0: not stated.
struct Kernel {
  const char* name;
  std::size_t bytes;
  constexpr Kernel(const char* its_name, std::size_t its_bytes = 0) : name(its_name), bytes(its_bytes) {}
};

struct KernelCost {
  long calls = 0;
  double seconds = 0;  // on the device
  double bytes = 0;    // of all calls, as their loops state them
};
using KernelCosts = std::map<std::string, KernelCost>;

template <class Device>
class KernelProfile;

struct Cpu;
template <>
class KernelProfile<Cpu> {
 public:
  explicit KernelProfile(Cpu&) {}
  void begin(const Kernel&) { start_ = std::chrono::steady_clock::now(); }
  void end(const Kernel& kernel);
  KernelCosts costs() { return costs_; }  // so far

 private:
  std::chrono::steady_clock::time_point start_;
  KernelCosts costs_;
};

// Profiles the device's work under the name of `kernel` until the end of the block.
template <class Device>
class Profiled {
 public:
  Profiled(Device& device, const Kernel& kernel) : profile_(device.profile.get()), kernel_(kernel) {
    if (profile_) profile_->begin(kernel_);
  }
  ~Profiled() {
    if (profile_) profile_->end(kernel_);
  }
  Profiled(const Profiled&) = delete;
  Profiled& operator=(const Profiled&) = delete;

 private:
  KernelProfile<Device>* profile_;
  Kernel kernel_;
};

}  // namespace hysteron
