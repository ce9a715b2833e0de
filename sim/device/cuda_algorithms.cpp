// Scans, minima and groups on a GPU, by CUB; they are a source of their own, since CUB's headers are longer
// than most of ours.
#include <cub/device/device_radix_sort.cuh>
#include <cub/device/device_reduce.cuh>
#include <cub/device/device_scan.cuh>

#include "sim/device/algorithms.h"

namespace hysteron {
namespace {

template <class Call>
void with_cub_memory(Cuda& cuda, Scratch<Cuda>& scratch, const Kernel& kernel, const Call& call) {
  ++device_counts.loops;
  if (cuda.batch) cuda.batch->send();
  std::size_t bytes = 0;
  check_cuda(call(nullptr, bytes), kernel.name);
  char* memory = scratch.memory.reserve(bytes);
  const Profiled<Cuda> profiled(cuda, kernel);
  check_cuda(call(memory, bytes), kernel.name);
}

}  // namespace

int exclusive_scan(Cuda& cuda, Scratch<Cuda>& scratch, const int* count, int n, int* start) {
  with_cub_memory(cuda, scratch, {"scan", 2 * n * sizeof(int)}, [&](void* memory, std::size_t& bytes) {
    return cub::DeviceScan::InclusiveSum(memory, bytes, count, start + 1, n, cuda.stream);
  });
  check_cuda(cudaMemsetAsync(start, 0, sizeof(int), cuda.stream), "scan");
  int total = 0;
  device_download(cuda, &total, start + n, sizeof(int));
  return total;
}

template <class Real>
Real smallest(Cuda& cuda, Scratch<Cuda>& scratch, const Real* value, int n, Real otherwise) {
  if (n == 0) return otherwise;
  Real* result = reinterpret_cast<Real*>(scratch.result.data());
  with_cub_memory(cuda, scratch, {"smallest", n * sizeof(Real)}, [&](void* memory, std::size_t& bytes) {
    return cub::DeviceReduce::Min(memory, bytes, value, result, n, cuda.stream);
  });
  Real least = 0;
  device_download(cuda, &least, result, sizeof(Real));
  return std::min(least, otherwise);
}

// Radix sort is stable; negative keys become the last row.
void group(Cuda& cuda, Scratch<Cuda>& scratch, const int* key, int n, int rows, int* start, int* item) {
  int *keys = scratch.keys.reserve(2 * static_cast<std::size_t>(n)), *sorted = keys + n;
  int* order = scratch.items.reserve(n);
  for_each(
      cuda, "group: keys", n, HYST_KERNEL(int i) {
        keys[i] = key[i] < 0 ? rows : key[i];
        order[i] = i;
      });
  int bits = 1;
  while ((rows >> bits) > 0) ++bits;
  if (n > 0)
    with_cub_memory(cuda, scratch, {"group", 4 * n * sizeof(int)}, [&](void* memory, std::size_t& bytes) {
      return cub::DeviceRadixSort::SortPairs(memory, bytes, keys, sorted, order, item, n, 0, bits,
                                             cuda.stream);
    });
  for_each(
      cuda, "group: rows", rows + 1, HYST_KERNEL(int r) {
        int low = 0, high = n;  // the first place whose key is at least r
        while (low < high) {
          const int middle = (low + high) / 2;
          if (sorted[middle] < r)
            low = middle + 1;
          else
            high = middle;
        }
        start[r] = low;
      });
}

template double smallest(Cuda&, Scratch<Cuda>&, const double*, int, double);
template float smallest(Cuda&, Scratch<Cuda>&, const float*, int, float);

}  // namespace hysteron
