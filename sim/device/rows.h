// Loops over long rows.  On a GPU a warp takes each row, with a part for each lane, or nine of its threads do
// where rows are many; on the CPU one lane walks the row from its first element to its last, as a plain loop
// would.
#pragma once

#include <type_traits>

#include "sim/device/device.h"

namespace hysteron {

// The single lane that walks a row on the CPU.
struct SingleLane {
  static constexpr int kCount = 1;
  HYST_HD int index() const { return 0; }
  HYST_HD bool leads() const { return true; }
  template <class Matrix>
  HYST_HD Matrix lane_sum(const Matrix& matrix) const {
    return matrix;
  }
};

// kThreads threads of a warp share a row on a GPU, with 32 / kThreads rows per warp; all of a row's threads
// call these functions together.
template <int kThreads>
struct LanesOfWarp {
  static constexpr int kWarp = 32, kCount = kThreads, kRows = kWarp / kThreads;
  HYST_HD int index() const { return in_warp() % kCount; }
  // Returns the index among the warp's rows; kRows: none.
  HYST_HD int slot() const { return kRows == 1 ? 0 : in_warp() / kCount; }
  HYST_HD bool leads() const { return index() == 0; }
  // Returns the value of the lane `by` places further; beyond the last it is arbitrary.
  template <class Real>
  HYST_HD Real further(Real value, [[maybe_unused]] int by) const {
#ifdef __CUDA_ARCH__
    return __shfl_down_sync(threads(), value, by);
#else
    return value;
#endif
  }
  template <class Real>
  HYST_HD Real lane_value(Real value, [[maybe_unused]] int lane) const {
#ifdef __CUDA_ARCH__
    return __shfl_sync(threads(), value, slot() * kCount + lane);
#else
    return value;
#endif
  }
  // Returns the sum of the lanes' matrices in a fixed order, valid in the leading lane.
  template <class Matrix>
  HYST_HD Matrix lane_sum(Matrix matrix) const {
    static_assert(kCount == kWarp, "halves of halves");
    for (int k = 0; k < static_cast<int>(Matrix::SizeAtCompileTime); ++k)
      for (int by = kCount / 2; by > 0; by /= 2) matrix.data()[k] += further(matrix.data()[k], by);
    return matrix;
  }

 private:
  HYST_HD static int in_warp() {
#ifdef __CUDA_ARCH__
    return threadIdx.x % kWarp;
#else
    return 0;
#endif
  }
  HYST_HD unsigned threads() const { return (0xffffffffu >> (kWarp - kCount)) << (slot() * kCount); }
};
using Warp = LanesOfWarp<32>;
// Nine lanes match the numbers of a 3x3 block: the loads of three rows wait together; five threads idle.
using NineLanes = LanesOfWarp<9>;

template <class Device>
using LanesOn = std::conditional_t<Device::kGpu, Warp, SingleLane>;

// Runs body(i, lanes) for i in [0, rows).  On a GPU nothing runs once *stop, in its memory, is not 0; a null
// `stop` never stops.
template <class Body>
void for_each_row(Cpu& cpu, const Kernel& kernel, int rows, const Body& body, const int* /*stop*/ = nullptr) {
  for_each(cpu, kernel, rows, [&](int i) { body(i, SingleLane{}); });
}

// Sums like for_each_sum(), with body(i, lanes, sums); only the leading lane adds to the sums.
template <int K, class Body, class Finish>
void for_each_row_sum(Cpu& cpu, const Kernel& kernel, int rows, const Body& body, const Finish& finish) {
  for_each_sum<K>(
      cpu, kernel, rows, [&](int i, Sums<K>& sums) { body(i, SingleLane{}, sums); }, finish);
}

// The most blocks of a sum over rows for each block of one over elements: rows keep more loads waiting.  An
// H100 runs them all at once if a thread takes no more than 40 registers, and the larger number if it takes
// 32.
inline constexpr int kRowSumBlocksEach = 3, kMaxSumBlocksEach = 4;

#ifdef __CUDACC__
inline constexpr int kWarpsPerBlock = kThreadsPerBlock / Warp::kCount;

template <class Lanes>
HYST_HD int warps_for(int rows) {
  return (rows + Lanes::kRows - 1) / Lanes::kRows;
}

// Runs the body for a thread's row, if it has one.
template <class Lanes, class Body, class... Terms>
__device__ void run_on_warp_row(int warp, int rows, const Body& body, Terms&... terms) {
  const Lanes lanes;
  const int i = warp * Lanes::kRows + lanes.slot();
  if (lanes.slot() < Lanes::kRows && i < rows) body(i, lanes, terms...);
}

template <class Lanes, class Body>
struct RowLoop {
  unsigned blocks;
  int rows;
  Body body;
  const int* stop;

  __device__ void operator()() const {
    if (stop && *stop) return;
    run_on_warp_row<Lanes>(blockIdx.x * kWarpsPerBlock + threadIdx.x / Warp::kCount, rows, body);
  }
};

template <class Lanes = Warp, class Body>
void for_each_row(Cuda& cuda, const Kernel& kernel, int rows, const Body& body, const int* stop = nullptr) {
  const unsigned blocks = blocks_for(warps_for<Lanes>(rows), kWarpsPerBlock);
  if (rows > 0) launch(cuda, kernel, RowLoop<Lanes, Body>{blocks, rows, body, stop});
}

// Warps take rows in turn, so that their threads are for_each_sum()'s elements.
template <class Lanes, class Body>
struct LaneOfRow {
  int rows;
  Body body;
  template <int K>
  __device__ void operator()(int i, Sums<K>& sums) const {
    run_on_warp_row<Lanes>(i / Warp::kCount, rows, body, sums);
  }
};

inline constexpr int kRowSumBlocks = kRowSumBlocksEach * kSumBlocks;

template <int K, class Lanes = Warp, class Body, class Finish>
void for_each_row_sum(Cuda& cuda, const Kernel& kernel, int rows, const Body& body, const Finish& finish,
                      int blocks_each = kRowSumBlocksEach) {
  const int warps = warps_for<Lanes>(rows), most = blocks_each * kSumBlocks;
  launch_sum<K>(cuda, kernel, warps * Warp::kCount, sum_blocks(warps, kWarpsPerBlock, most), most,
                LaneOfRow<Lanes, Body>{rows, body}, finish);
}
#endif

}  // namespace hysteron
