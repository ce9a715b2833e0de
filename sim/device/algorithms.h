// Scans, minima and groups on one device, with the same bits whatever the number of threads.
#pragma once

#include <algorithm>
#include <numeric>

#include "sim/device/device.h"

namespace hysteron {

// Memory that grows when asked for more and keeps what it has when asked for less; growing loses the
// contents.
template <class T, class Device>
class GrowingBuffer {
 public:
  explicit GrowingBuffer(Device& device) : device_(&device) {}
  T* reserve(std::size_t size) {
    if (size > buffer_.size()) {
      buffer_ = {};
      buffer_ = Buffer<T, Device>(*device_, size + size / 4);
    }
    return buffer_.data();
  }
  T* data() { return buffer_.data(); }
  const T* data() const { return buffer_.data(); }
  std::size_t bytes() const { return buffer_.bytes(); }
  void swap(GrowingBuffer& other) { std::swap(buffer_, other.buffer_); }

 private:
  Device* device_;
  Buffer<T, Device> buffer_;
};

// The scratch memory of the functions below.
template <class Device>
struct Scratch {
  explicit Scratch(Device& device) : memory(device), keys(device), items(device), result(device, 1) {}
  GrowingBuffer<char, Device> memory;
  GrowingBuffer<int, Device> keys, items;
  Buffer<double, Device> result;
  std::size_t bytes() const { return memory.bytes() + keys.bytes() + items.bytes() + result.bytes(); }
};

// Sets start[i] = count[0] + ... + count[i-1] for i in [0, n]; start has n + 1 elements.  Returns start[n].
inline int exclusive_scan(Cpu& cpu, Scratch<Cpu>&, const int* count, int n, int* start) {
  ++device_counts.loops;
  const Profiled<Cpu> profiled(cpu, {"scan", 2 * n * sizeof(int)});
  start[0] = 0;
  for (int i = 0; i < n; ++i) start[i + 1] = start[i] + count[i];
  return start[n];
}

// Returns the least of n values, or `otherwise` if that is less.
template <class Real>
Real smallest(Cpu& cpu, Scratch<Cpu>&, const Real* value, int n, Real otherwise) {
  if (n == 0) return otherwise;
  ++device_counts.loops;
  const Profiled<Cpu> profiled(cpu, {"smallest", n * sizeof(Real)});
  for (int i = 0; i < n; ++i) otherwise = std::min(otherwise, value[i]);
  return otherwise;
}

// Groups n items by their key in [0, rows): row r is item[start[r]] ... item[start[r+1]-1], in ascending
// order, with rows + 1 starts.  Negative keys belong to no row.
inline void group(Cpu& cpu, Scratch<Cpu>& scratch, const int* key, int n, int rows, int* start, int* item) {
  ++device_counts.loops;
  const Profiled<Cpu> profiled(cpu, {"group", (2 * n + rows) * sizeof(int)});
  int* next = scratch.keys.reserve(rows + 1);
  std::fill(next, next + rows + 1, 0);
  for (int i = 0; i < n; ++i)
    if (key[i] >= 0) ++next[key[i] + 1];
  std::partial_sum(next, next + rows + 1, next);
  std::copy(next, next + rows + 1, start);
  for (int i = 0; i < n; ++i)
    if (key[i] >= 0) item[next[key[i]]++] = i;
}

#ifdef __CUDACC__
// These do the same by CUB (cuda_algorithms.cpp).
int exclusive_scan(Cuda& cuda, Scratch<Cuda>& scratch, const int* count, int n, int* start);
template <class Real>
Real smallest(Cuda& cuda, Scratch<Cuda>& scratch, const Real* value, int n, Real otherwise);
void group(Cuda& cuda, Scratch<Cuda>& scratch, const int* key, int n, int rows, int* start, int* item);
#endif

}  // namespace hysteron
