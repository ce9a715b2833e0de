// Makes a device repeat loops by itself until it finds them done: on a GPU this is a graph with a conditional
// node, so that the host neither waits for each round nor sends rounds that are not needed.
#pragma once

#include <utility>
#include <vector>

#include "sim/device/device.h"

namespace hysteron {

template <class Device>
class WhileLoop;

template <>
class WhileLoop<Cpu> {
 public:
  // Returns false: the caller repeats the loops.
  template <class Order>
  bool run(Cpu&, const std::vector<const void*>&, const int*, const Order&) {
    return false;
  }
};

#ifdef __CUDACC__
#if CUDART_VERSION >= 12040
template <class Flag>
__global__ void loop_condition_kernel(cudaGraphConditionalHandle loop_condition, const Flag* done) {
  cudaGraphSetConditional(loop_condition, *done == 0);
}
#endif

template <>
class WhileLoop<Cuda> {
 public:
  WhileLoop() = default;
  WhileLoop(const WhileLoop&) = delete;
  WhileLoop& operator=(const WhileLoop&) = delete;
  ~WhileLoop() { forget(); }

  // Repeats the loops that order() orders until *done, in the GPU's memory, is not 0; from then on they must
  // change nothing, for a round may follow.  Orders of one key are the same loops over the same memory: they
  // are captured once, after a first round in which they may allocate memory that later ones use.  Returns
  // false, and leaves the rest to the caller, where the driver cannot do it, where it must not, and where
  // kernels are profiled one by one.
  template <class Order>
  bool run(Cuda& cuda, const std::vector<const void*>& key, const int* done, const Order& order) {
    if (cuda.batch) {
      cuda.batch->repeat(done, order);
      return true;
    }
    if (cuda.profile || !cuda.graphs) return false;
    cudaGraphExec_t loop = known(key, cuda.partial);
    if (!loop && works_) {
      order();
      loop = captured(cuda, key, done, order);
    }
    if (!loop) return false;
    ++device_counts.loops;
    check_cuda(cudaGraphLaunch(loop, cuda.stream), "loop on the device");
    return true;
  }

 private:
  static constexpr std::size_t kMaxKept = 8;
  struct Archived {
    std::vector<const void*> key;
    const double* partial;  // scratch of sums, which grows
    cudaGraphExec_t loop;
  };

  cudaGraphExec_t known(const std::vector<const void*>& key, const double* partial) const {
    for (const Archived& kept : kept_)
      if (kept.key == key && kept.partial == partial) return kept.loop;
    return nullptr;
  }

  template <class Order>
  cudaGraphExec_t captured(Cuda& cuda, const std::vector<const void*>& key, const int* done,
                           const Order& order) {
    cudaGraph_t graph = nullptr;
    cudaGraphExec_t loop = nullptr;
    works_ = cudaGraphCreate(&graph, 0) == cudaSuccess && capture(cuda, graph, done, order) &&
             cudaGraphInstantiate(&loop, graph, 0) == cudaSuccess;
    if (graph) cudaGraphDestroy(graph);
    cudaGetLastError();  // clears the error, which the next launch must not find
    if (!works_) return nullptr;
    if (kept_.size() == kMaxKept) forget();
    kept_.push_back({key, cuda.partial, loop});
    return loop;
  }

  template <class Order>
  static bool capture(Cuda& cuda, cudaGraph_t graph, const int* done, const Order& order) {
#if CUDART_VERSION >= 12040
    cudaGraphConditionalHandle loop_condition;
    if (cudaGraphConditionalHandleCreate(&loop_condition, graph, 1, cudaGraphCondAssignDefault) !=
        cudaSuccess)
      return false;
    cudaGraphNodeParams condition{};
    condition.type = cudaGraphNodeTypeConditional;
    condition.conditional.handle = loop_condition;
    condition.conditional.type = cudaGraphCondTypeWhile;
    condition.conditional.size = 1;
    if (add_node(graph, condition) != cudaSuccess) return false;
    cudaGraph_t body = condition.conditional.phGraph_out[0];
    if (cudaStreamBeginCaptureToGraph(cuda.stream, body, nullptr, nullptr, 0,
                                      cudaStreamCaptureModeThreadLocal) != cudaSuccess)
      return false;
    bool ordered = true;
    const bool early_blocks = std::exchange(cuda.early_blocks, false);  // slower in a graph
    try {
      order();
      loop_condition_kernel<<<1, 1, 0, cuda.stream>>>(loop_condition, done);
    } catch (const Error&) {  // a real error occurs again without capture
      ordered = false;
    }
    cuda.early_blocks = early_blocks;
    return cudaStreamEndCapture(cuda.stream, &body) == cudaSuccess && ordered;
#else
    return false;
#endif
  }

#if CUDART_VERSION >= 12040
  static cudaError_t add_node(cudaGraph_t graph, cudaGraphNodeParams& node) {
    cudaGraphNode_t added;
#if CUDART_VERSION >= 13000
    return cudaGraphAddNode(&added, graph, nullptr, nullptr, 0, &node);
#else
    return cudaGraphAddNode(&added, graph, nullptr, 0, &node);
#endif
  }
#endif

  void forget() {
    for (const Archived& kept : kept_) cudaGraphExecDestroy(kept.loop);
    kept_.clear();
  }

  bool works_ = true;
  std::vector<Archived> kept_;
};
#endif

}  // namespace hysteron
