// Holds a few numbers that loops write and the host reads.
#pragma once

#include <new>
#include <type_traits>

#include "sim/device/device.h"

namespace hysteron {

// On a GPU they lie in pinned memory of the host: once it has waited for the device, reading them costs
// neither a copy nor another wait.  Loops write them once; sums over loops belong in a Buffer.
template <class T, class Device>
class HostResult {
 public:
  explicit HostResult(Device& device) : device_(device), value_(new (host_allocate(device, sizeof(T))) T{}) {
    static_assert(std::is_trivially_copyable_v<T>);
  }
  ~HostResult() { host_free(device_, value_); }
  HostResult(const HostResult&) = delete;
  HostResult& operator=(const HostResult&) = delete;

  T* data() { return value_; }
  const T& operator*() const { return *value_; }  // as of the host's last wait

 private:
  Device& device_;
  T* value_;
};

}  // namespace hysteron
