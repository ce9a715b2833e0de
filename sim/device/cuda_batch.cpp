// Only nvcc compiles this file.
#include <algorithm>
#include <utility>

#include "sim/device/cuda.h"

namespace hysteron {
namespace {

thread_local CudaBatch* running = nullptr;

__global__ void all_done_kernel(const BatchedLoop* ordered, unsigned members, int* all_done) {
  int done = 1;
  for (unsigned m = threadIdx.x; m < members; m += blockDim.x) done = done && *ordered[m].stop != 0;
  done = __syncthreads_and(done);
  if (threadIdx.x == 0) *all_done = done;
}

}  // namespace

CudaBatch::CudaBatch(int device, int members) : device_(device), member_(members) {
  check_cuda(cudaSetDevice(device_), "select device");
  check_cuda(cudaStreamCreateWithFlags(&stream_, cudaStreamNonBlocking), "create stream");
  check_cuda(cudaMallocHost(&arena_, kArena * members), "allocate on the host");
  check_cuda(cudaMalloc(&arena_on_gpu_, kArena * members), "allocate");
  check_cuda(cudaMallocHost(&all_done_, sizeof(int)), "allocate on the host");
}

CudaBatch::~CudaBatch() {
  cudaFreeHost(all_done_);
  cudaFree(loop_on_gpu_);
  cudaFreeHost(pinned_loop_);
  cudaFree(arena_on_gpu_);
  cudaFreeHost(arena_);
  cudaStreamDestroy(stream_);
}

CudaBatch* CudaBatch::current() { return running; }

void CudaBatch::run(const std::function<void(int)>& job) {
  struct Restored {
    CudaBatch* before;
    ~Restored() { running = before; }
  } const restored{std::exchange(running, this)};
  fibers_.run(static_cast<int>(member_.size()), job, [this] { launch_all(); });
}

// Makes room; if an order does not fit, earlier orders are launched first.
CudaBatch::Place CudaBatch::room(std::size_t size) {
  size = (size + kAlignment - 1) / kAlignment * kAlignment;
  if (member().used + size > kArena) {
    if (member().repeats) throw Error::system("GPU: a batch has no room for a round of a repeated loop");
    wait();
  }
  const std::size_t offset = kArena * fibers_.current() + member().used;
  member().used += size;
  return {arena_ + offset, arena_on_gpu_ + offset};
}

// Makes room for one round of a repeated loop, which must not be launched in parts.
void CudaBatch::make_room() {
  if (member().used > kArena / 2) wait();
}

void CudaBatch::launch_all() {
  std::size_t used = 0;
  std::vector<Pending> pending;
  for (int m = 0; m < static_cast<int>(member_.size()); ++m) {
    used = std::max(used, member_[m].used);
    const int orders = static_cast<int>(member_[m].orders.size());
    if (orders > 0) pending.push_back({m, 0, orders, nullptr});
  }
  if (used > 0)
    check_cuda(cudaMemcpy2DAsync(arena_on_gpu_, kArena, arena_, kArena, used, member_.size(),
                                 cudaMemcpyHostToDevice, stream_),
               "batch");
  if (!pending.empty()) {
    gather(std::move(pending));
    upload();
    launch(0, group_.size());
  }
  check_cuda(cudaStreamSynchronize(stream_), "batch");
  for (Member& member : member_) {
    member.orders.clear();
    member.used = 0;
  }
  group_.clear();
  loop_.clear();
  collect_garbage();
}

// The member with the most remaining orders leads: members that are ahead of it wait for it.
void CudaBatch::gather(std::vector<Pending> pending) {
  const auto left = [](const Pending& p) { return p.end - p.next; };
  for (;;) {
    const auto leader = std::max_element(pending.begin(), pending.end(),
                                         [&](const auto& a, const auto& b) { return left(a) < left(b); });
    if (left(*leader) == 0) return;
    const Order head = member_[leader->member].orders[leader->next];
    const std::size_t index = group_.size();
    group_.push_back({head.launch, head.name, loop_.size(), 0, 0, 0});
    std::vector<Pending> inner;
    for (Pending& p : pending) {
      if (left(p) == 0) continue;
      const Order& order = member_[p.member].orders[p.next];
      if (order.launch != head.launch) continue;
      loop_.push_back({order.loop, order.launch ? p.stop : order.done});
      group_[index].blocks = std::max(group_[index].blocks, order.blocks);
      ++group_[index].members;
      if (!order.launch) inner.push_back({p.member, p.next + 1, order.end, order.done});
      p.next = order.launch ? p.next + 1 : order.end;
    }
    if (!inner.empty()) gather(std::move(inner));
    group_[index].end = group_.size();
  }
}

void CudaBatch::upload() {
  if (loop_.size() > loop_room_) {
    check_cuda(cudaFree(loop_on_gpu_), "batch");
    check_cuda(cudaFreeHost(pinned_loop_), "batch");
    loop_room_ = 2 * loop_.size();
    check_cuda(cudaMalloc(&loop_on_gpu_, loop_room_ * sizeof(BatchedLoop)), "allocate");
    check_cuda(cudaMallocHost(&pinned_loop_, loop_room_ * sizeof(BatchedLoop)), "allocate on the host");
  }
  std::copy(loop_.begin(), loop_.end(), pinned_loop_);
  check_cuda(cudaMemcpyAsync(loop_on_gpu_, pinned_loop_, loop_.size() * sizeof(BatchedLoop),
                             cudaMemcpyHostToDevice, stream_),
             "batch");
}

void CudaBatch::launch(std::size_t first, std::size_t end) {
  for (std::size_t g = first; g < end;) {
    const Group& group = group_[g];
    if (group.launch) {
      group.launch(loop_on_gpu_ + group.first, group.blocks, group.members, stream_);
      check_cuda(cudaGetLastError(), group.name);
      ++g;
    } else {
      launch_repeatedly(group, g + 1);
      g = group.end;
    }
  }
}

void CudaBatch::launch_repeatedly(const Group& group, std::size_t first) {
  constexpr int kRounds = 2, kThreads = 256;  // kRounds: between two checks whether all are done
  do {
    for (int k = 0; k < kRounds; ++k) launch(first, group.end);
    all_done_kernel<<<1, kThreads, 0, stream_>>>(loop_on_gpu_ + group.first, group.members, all_done_);
    check_cuda(cudaStreamSynchronize(stream_), group.name);
  } while (!*all_done_);
}

void CudaBatch::collect_garbage() {
  for (const Garbage& garbage : garbage_) garbage.release(garbage.memory);
  garbage_.clear();
}

}  // namespace hysteron
