// The CPU as a device runs OpenMP threads over the same loop bodies as the GPU.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstring>
#include <memory>
#include <string>
#include <vector>

#include "sim/device/device_counts.h"
#include "sim/device/host_device.h"
#include "sim/device/kernel_profile.h"

namespace hysteron {

// K sums at once; a loop body adds to them, and for_each_sum() adds the bodies' sums in a fixed order.
template <int K>
struct Sums {
  double term[K] = {};
};

// Loops shorter than this run on one thread: waking the others costs more than they do.
inline constexpr int kSerialLoop = 512;
// Elements per partial sum; the number is fixed, so that the order of additions does not depend on the number
// of threads.
inline constexpr int kSumBlock = 256;

// The number of cores that others use meanwhile, as a renderer without graphics hardware does: threads that
// wait for one that has no core would spin in vain.  No result depends on the number of threads.
inline std::atomic<int> lent_cores = 0;
class ReservedCore {
 public:
  ReservedCore() { ++lent_cores; }
  ~ReservedCore() { --lent_cores; }
  ReservedCore(const ReservedCore&) = delete;
  ReservedCore& operator=(const ReservedCore&) = delete;
};

struct Cpu {
  static constexpr bool kGpu = false;
  int threads = 1;
  std::size_t bytes = 0;             // allocated by Buffers
  std::vector<double> partial = {};  // scratch of for_each_sum()
  std::unique_ptr<KernelProfile<Cpu>> profile = {};

  explicit Cpu(int thread_count);
  int threads_left() const { return std::max(1, threads - lent_cores.load(std::memory_order_relaxed)); }
  std::string description() const;
  int cuda_device() const { return -1; }
  void synchronize() const {}
};

// Returns where part k of `parts` equal ones of n items begins.
inline int part_begin(int n, int k, int parts) { return static_cast<int>(static_cast<long>(n) * k / parts); }

// Calls body(i) for i in [begin, end).  One instance serves one thread and many.  The body's captures are
// copied: stores of the loop cannot change the copy, so that its numbers stay in registers.
template <class Body>
HYST_NOINLINE void run_serially(int begin, int end, const Body& body) {
  const Body own = body;  // NOLINT(performance-unnecessary-copy-initialization)
  for (int i = begin; i < end; ++i) own(i);
}

// Runs body(i) for i in [0, n).
template <class Body>
void for_each(Cpu& cpu, const Kernel& kernel, int n, const Body& body) {
  if (n == 0) return;
  ++device_counts.loops;
  const Profiled<Cpu> profiled(cpu, kernel);
  const int threads = cpu.threads_left();
  if (n < kSerialLoop || threads == 1) return run_serially(0, n, body);
#pragma omp parallel for schedule(static) num_threads(threads)
  for (int t = 0; t < threads; ++t)
    run_serially(part_begin(n, t, threads), part_begin(n, t + 1, threads), body);
}

// Runs a loop of rare measurements: a batch of cloths on a GPU does not share its launch, so that it is
// compiled once and not twice.
template <class Body>
void for_each_alone(Cpu& cpu, const Kernel& kernel, int n, const Body& body) {
  for_each(cpu, kernel, n, body);
}

// Computes the partial sums of the blocks [first, last).
template <int K, class Body>
HYST_NOINLINE void sum_serially(int first, int last, int n, const Body& body, double* partial) {
  const Body own = body;  // NOLINT(performance-unnecessary-copy-initialization)
  for (int b = first; b < last; ++b) {
    Sums<K> sums;
    const int end = std::min(n, (b + 1) * kSumBlock);
    for (int i = b * kSumBlock; i < end; ++i) own(i, sums);
    for (int k = 0; k < K; ++k) partial[b * K + k] = sums.term[k];
  }
}

// Sets total[k] to the sum over i of the terms that body(i, sums) adds; then finish(total) runs once.
template <int K, class Body, class Finish>
void for_each_sum(Cpu& cpu, const Kernel& kernel, int n, const Body& body, const Finish& finish) {
  ++device_counts.loops;
  const Profiled<Cpu> profiled(cpu, kernel);
  const int blocks = (n + kSumBlock - 1) / kSumBlock, threads = cpu.threads_left();
  if (static_cast<int>(cpu.partial.size()) < blocks * K) cpu.partial.resize(blocks * K);
  double* partial = cpu.partial.data();
  if (n < kSerialLoop || threads == 1) {
    sum_serially<K>(0, blocks, n, body, partial);
  } else {
#pragma omp parallel for schedule(static) num_threads(threads)
    for (int t = 0; t < threads; ++t)
      sum_serially<K>(part_begin(blocks, t, threads), part_begin(blocks, t + 1, threads), n, body, partial);
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
inline void* host_allocate(Cpu&, std::size_t bytes) {
  ++device_counts.allocations;
  return ::operator new(bytes);
}
inline void host_free(Cpu&, void* memory) { ::operator delete(memory); }

}  // namespace hysteron
