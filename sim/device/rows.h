// Loops over long rows.  On a GPU a warp takes each row, its lanes a part of it each; on the CPU one lane
// walks the row from its first element to its last, as a plain loop would.
#pragma once

#include "sim/device/device.h"

namespace hysteron {

// Who walks a row on the CPU.
struct SingleLane {
  static constexpr int kCount = 1;
  HYST_HD int index() const { return 0; }
  HYST_HD bool leads() const { return true; }
  template <class Matrix>
  HYST_HD Matrix sum_of(const Matrix& matrix) const {
    return matrix;
  }
};

// The 32 threads that take a row on a GPU; all of them call these functions together.
struct Warp {
  static constexpr int kCount = 32;
  HYST_HD int index() const {
#ifdef __CUDA_ARCH__
    return threadIdx.x % kCount;
#else
    return 0;
#endif
  }
  HYST_HD bool leads() const { return index() == 0; }
  // The value of the lane `by` places further; beyond the last, one's own.
  template <class Real>
  HYST_HD Real further(Real value, [[maybe_unused]] int by) const {
#ifdef __CUDA_ARCH__
    return __shfl_down_sync(0xffffffffu, value, by);
#else
    return value;
#endif
  }
  template <class Real>
  HYST_HD Real value_of(Real value, [[maybe_unused]] int lane) const {
#ifdef __CUDA_ARCH__
    return __shfl_sync(0xffffffffu, value, lane);
#else
    return value;
#endif
  }
  // Sum of the lanes' matrices in a fixed order; valid in the lane that leads.
  template <class Matrix>
  HYST_HD Matrix sum_of(Matrix matrix) const {
    for (int k = 0; k < static_cast<int>(Matrix::SizeAtCompileTime); ++k)
      for (int by = kCount / 2; by > 0; by /= 2) matrix.data()[k] += further(matrix.data()[k], by);
    return matrix;
  }
};

template <class Device>
struct LanesOf;
template <>
struct LanesOf<Cpu> {
  using Type = SingleLane;
};
#ifdef __CUDACC__
template <>
struct LanesOf<Cuda> {
  using Type = Warp;
};
#endif
template <class Device>
using LanesOn = typename LanesOf<Device>::Type;

// Runs body(i, lanes) for i in [0, rows).  On a GPU nothing runs once *stop, in its memory, is not 0; null:
// whatever happens.
template <class Body>
void for_each_row(Cpu& cpu, const Kernel& kernel, int rows, const Body& body, const int* /*stop*/ = nullptr) {
  for_each(cpu, kernel, rows, [&](int i) { body(i, SingleLane{}); });
}

// As for_each_sum(), with body(i, lanes, sums); only the lane that leads adds to the sums.
template <int K, class Body, class Finish>
void for_each_row_sum(Cpu& cpu, const Kernel& kernel, int rows, const Body& body, const Finish& finish) {
  for_each_sum<K>(
      cpu, kernel, rows, [&](int i, Sums<K>& sums) { body(i, SingleLane{}, sums); }, finish);
}

#ifdef __CUDACC__
inline constexpr int kRowsPerBlock = kThreadsPerBlock / Warp::kCount;

template <class Body>
struct RowLoop {
  unsigned blocks;
  int rows;
  Body body;
  const int* stop;

  __device__ void operator()() const {
    if (stop && *stop) return;
    const int i = blockIdx.x * kRowsPerBlock + threadIdx.x / Warp::kCount;
    if (i < rows) body(i, Warp{});
  }
};

template <class Body>
void for_each_row(Cuda& cuda, const Kernel& kernel, int rows, const Body& body, const int* stop = nullptr) {
  if (rows > 0) launch(cuda, kernel, RowLoop<Body>{blocks_for(rows, kRowsPerBlock), rows, body, stop});
}

// Warps take rows in turn, which makes for_each_sum()'s elements of them.
template <class Body>
struct LaneOfRow {
  Body body;
  template <int K>
  __device__ void operator()(int i, Sums<K>& sums) const {
    body(i / Warp::kCount, Warp{}, sums);
  }
};

// Three times the blocks of a sum over elements: rows keep more loads waiting.
inline constexpr int kRowSumBlocks = 3 * kSumBlocks;

template <int K, class Body, class Finish>
void for_each_row_sum(Cuda& cuda, const Kernel& kernel, int rows, const Body& body, const Finish& finish) {
  launch_sum<K>(cuda, kernel, rows * Warp::kCount, sum_blocks(rows, kRowsPerBlock, kRowSumBlocks),
                kRowSumBlocks, LaneOfRow<Body>{body}, finish);
}
#endif

}  // namespace hysteron
