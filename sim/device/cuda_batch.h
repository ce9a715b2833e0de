// Runs many small cloths on one GPU: the loops that their simulations order are gathered, and common ones are
// launched once for all of them.  Included by cuda.h.
#pragma once

#include <cuda_runtime.h>

#include <cstring>
#include <functional>
#include <new>
#include <vector>

#include "sim/device/fibers.h"

namespace hysteron {

// One member's loop in the GPU's memory.
struct BatchedLoop {
  const void* loop;
  const int* stop;  // the loop is skipped if *stop is not 0; null: never
};

// The blocks (., y) run the loop of the y-th member.
template <class Loop>
__device__ void run_batched(const BatchedLoop* ordered) {
  const BatchedLoop mine = ordered[blockIdx.y];
  if (mine.stop && *mine.stop) return;
  const Loop loop = *static_cast<const Loop*>(mine.loop);
  if (blockIdx.x < loop.blocks) loop();
}

// Simulations whose jobs take turns on one thread, each until it waits for the GPU.  Then all ordered loops
// are launched: loops that are next for several members in one launch.  A member's loops keep their order and
// their blocks, so that its bits are those of a run by itself.
class CudaBatch {
 public:
  // Launches one kernel for so many members, with so many blocks each.
  using Launch = void (*)(const BatchedLoop*, unsigned blocks, unsigned members, cudaStream_t);
  // This is cudaFree or cudaFreeHost.
  using Release = cudaError_t (*)(void*);

  CudaBatch(int device, int members);
  ~CudaBatch();
  CudaBatch(const CudaBatch&) = delete;
  CudaBatch& operator=(const CudaBatch&) = delete;

  // Runs job(i) for each member i; devices that a job makes belong to this batch.  After all have ended it
  // throws the first exception of a job.
  void run(const std::function<void(int)>& job);
  // Returns the batch whose job the calling thread runs; null: none.
  static CudaBatch* current();

  cudaStream_t stream() const { return stream_; }

  template <class Loop>
  void order(Launch launch, const char* name, const Loop& loop) {
    static_assert(alignof(Loop) <= kAlignment);
    const Place place = room(sizeof(Loop));
    new (place.host) Loop(loop);
    member().orders.push_back({launch, name, place.device, loop.blocks, nullptr, 0});
  }
  // Repeats the loops that orders() orders until *done, in the GPU's memory, is not 0; from then on they must
  // change nothing.
  template <class Orders>
  void repeat(const int* done, const Orders& orders) {
    make_room();
    const std::size_t first = member().orders.size();
    member().orders.push_back({nullptr, "loop on the device", nullptr, 0, done, 0});
    member().repeats = true;
    orders();
    member().repeats = false;
    member().orders[first].end = static_cast<int>(member().orders.size());
  }
  // Waits until the GPU has done the loops that this member has ordered.
  void wait() { fibers_.wait(); }
  // Waits if any order has not been launched.
  void send() {
    if (!member().orders.empty()) wait();
  }
  // Returns a copy of the host's bytes in the GPU's memory, valid until this member waits.
  const char* staged_copy(const void* bytes, std::size_t size) {
    const Place place = room(size);
    std::memcpy(place.host, bytes, size);
    return static_cast<const char*>(place.device);
  }
  // Releases memory that ordered loops may still use, later.
  void release_later(void* memory, Release by) { garbage_.push_back({memory, by}); }

 private:
  static constexpr std::size_t kAlignment = 16, kArena = std::size_t(1) << 16;
  struct Order {
    Launch launch;  // null: repeats the orders up to `end` until *done
    const char* name;
    const void* loop;
    unsigned blocks;
    const int* done;
    int end;
  };
  struct Member {
    std::vector<Order> orders;
    std::size_t used = 0;  // bytes of its arena
    bool repeats = false;
  };
  struct Place {
    void* host;
    const void* device;
  };
  // Orders of one member that no launch contains yet.
  struct Pending {
    int member, next, end;
    const int* stop;
  };
  // One launch; without a kernel it repeats the launches up to `end` until all its members are done.
  struct Group {
    Launch launch;
    const char* name;
    std::size_t first;
    unsigned members, blocks;
    std::size_t end;
  };
  struct Garbage {
    void* memory;
    Release release;
  };

  Member& member() { return member_[fibers_.current()]; }
  Place room(std::size_t size);
  void make_room();
  void launch_all();
  void gather(std::vector<Pending> pending);
  void upload();
  void launch(std::size_t first, std::size_t end);
  void launch_repeatedly(const Group& group, std::size_t first);
  void collect_garbage();

  int device_;
  cudaStream_t stream_ = nullptr;
  Fibers fibers_;
  std::vector<Member> member_;
  char *arena_ = nullptr, *arena_on_gpu_ = nullptr;  // kArena bytes per member
  std::vector<Group> group_;
  std::vector<BatchedLoop> loop_;
  BatchedLoop *pinned_loop_ = nullptr, *loop_on_gpu_ = nullptr;
  std::size_t loop_room_ = 0;
  int* all_done_ = nullptr;  // pinned
  std::vector<Garbage> garbage_;
};

}  // namespace hysteron
