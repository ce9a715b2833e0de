// The CPU as a device: OpenMP threads over the same loop bodies that the GPU runs.
#pragma once

#include <algorithm>
#include <cstring>
#include <string>
#include <vector>

#include "sim/device/device_counts.h"
#include "sim/device/host_device.h"

namespace hysteron {

// Sums of K terms at once; a loop body adds to them, for_each_sum() adds the bodies' sums in a fixed order.
template <int K>
struct Sums {
  double term[K] = {};
};

// Loops shorter than this run on one thread: waking the others costs more than they do.
inline constexpr int kSerialLoop = 2048;
// Elements per partial sum.  Fixed, so that the order of additions does not depend on the number of threads.
inline constexpr int kSumBlock = 256;

struct Cpu {
  static constexpr bool kGpu = false;
  int threads = 1;
  std::size_t bytes = 0;             // allocated by Buffers
  std::vector<double> partial = {};  // scratch of for_each_sum

  explicit Cpu(int thread_count);
  std::string description() const;
  int cuda_device() const { return -1; }
  void synchronize() const {}
};

// Runs body(i) for i in [0, n).  `name` names the loop in profiles and errors.
template <class Body>
void for_each(Cpu& cpu, const char* /*name*/, int n, const Body& body) {
  ++device_counts.loops;
#pragma omp parallel for schedule(static) num_threads(cpu.threads) if (n >= kSerialLoop)
  for (int i = 0; i < n; ++i) body(i);
}

// total[k] = sum over i of the terms that body(i, sums) adds; then finish(total) runs once.
template <int K, class Body, class Finish>
void for_each_sum(Cpu& cpu, const char* /*name*/, int n, const Body& body, const Finish& finish) {
  ++device_counts.loops;
  const int blocks = (n + kSumBlock - 1) / kSumBlock;
  if (static_cast<int>(cpu.partial.size()) < blocks * K) cpu.partial.resize(blocks * K);
  double* partial = cpu.partial.data();
#pragma omp parallel for schedule(static) num_threads(cpu.threads) if (n >= kSerialLoop)
  for (int b = 0; b < blocks; ++b) {
    Sums<K> sums;
    const int end = std::min(n, (b + 1) * kSumBlock);
    for (int i = b * kSumBlock; i < end; ++i) body(i, sums);
    for (int k = 0; k < K; ++k) partial[b * K + k] = sums.term[k];
  }
  Sums<K> total;
  for (int b = 0; b < blocks; ++b)
    for (int k = 0; k < K; ++k) total.term[k] += partial[b * K + k];
  finish(total);
}

inline void* device_allocate(Cpu& cpu, std::size_t bytes) {
  ++device_counts.allocations;
  cpu.bytes += bytes;
  void* memory = ::operator new(bytes, std::align_val_t(64));
  std::memset(memory, 0, bytes);
  return memory;
}
inline void device_free(Cpu& cpu, void* memory, std::size_t bytes) {
  cpu.bytes -= bytes;
  ::operator delete(memory, std::align_val_t(64));
}
inline void device_upload(Cpu&, void* to, const void* from, std::size_t bytes) {
  std::memcpy(to, from, bytes);
}
inline void device_download(Cpu&, void* to, const void* from, std::size_t bytes) {
  std::memcpy(to, from, bytes);
}

}  // namespace hysteron
