// Memory that lives on one device.  It is zero-initialised, and moved, never copied by accident.
#pragma once

#include <numeric>
#include <utility>
#include <vector>

#include "sim/device/cpu.h"
#ifdef __CUDACC__
#include "sim/device/cuda.h"
#endif

namespace hysteron {

template <class T, class Device>
class Buffer {
 public:
  Buffer() = default;
  Buffer(Device& device, std::size_t size) : device_(&device), size_(size) {
    if (size) data_ = static_cast<T*>(device_allocate(device, size * sizeof(T)));
  }
  Buffer(Device& device, const std::vector<T>& values) : Buffer(device, values.size()) { upload(values); }
  Buffer(Buffer&& other) noexcept { swap(other); }
  Buffer& operator=(Buffer&& other) noexcept {
    swap(other);
    return *this;
  }
  ~Buffer() {
    if (data_) device_free(*device_, data_, size_ * sizeof(T));
  }

  T* data() { return data_; }
  const T* data() const { return data_; }
  std::size_t size() const { return size_; }
  std::size_t bytes() const { return size_ * sizeof(T); }

  void upload(const std::vector<T>& values) {
    if (!values.empty()) device_upload(*device_, data_, values.data(), values.size() * sizeof(T));
  }
  std::vector<T> download() const {
    std::vector<T> values(size_);
    if (size_) device_download(*device_, values.data(), data_, bytes());
    return values;
  }
  // Returns the sum of all elements, which the host adds in their order.
  double sum() const {
    const std::vector<T> values = download();
    return std::accumulate(values.begin(), values.end(), 0.0);
  }

 private:
  void swap(Buffer& other) {
    std::swap(device_, other.device_);
    std::swap(data_, other.data_);
    std::swap(size_, other.size_);
  }
  Device* device_ = nullptr;
  T* data_ = nullptr;
  std::size_t size_ = 0;
};

// Returns a copy of the device's array, `size` elements from `data` on.
template <class T, class Device>
std::vector<T> downloaded(Device& device, const T* data, std::size_t size) {
  std::vector<T> values(size);
  if (size) device_download(device, values.data(), data, size * sizeof(T));
  return values;
}

// Counts the bytes of arrays that a loop reads or writes whole.
template <class... Buffers>
std::size_t total_bytes(const Buffers&... buffer) {
  return (std::size_t(0) + ... + buffer.bytes());
}

}  // namespace hysteron
