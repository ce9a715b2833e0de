#include "sim/device/fibers.h"

#include <cxxabi.h>
#include <sys/mman.h>
#include <ucontext.h>

#include <cerrno>
#include <cstring>
#include <exception>
#include <utility>

#include "sim/base/error.h"
#include "sim/base/job.h"
#include "sim/device/device_counts.h"

namespace hysteron {
namespace {

// A fiber's stack is as large as a process's: a job may be a whole run.  Only touched pages take memory.
constexpr std::size_t kStack = std::size_t(8) << 20, kGuard = std::size_t(1) << 16;  // [bytes]

// The layout is that of the Itanium C++ ABI (2.2.2).
struct ExceptionState {
  void* caught = nullptr;
  unsigned uncaught = 0;
};
ExceptionState& exception_state() { return *reinterpret_cast<ExceptionState*>(abi::__cxa_get_globals()); }

// State that belongs to a job although the thread holds it.
struct OfThread {
  DeviceCounts counts = {};
  ExceptionState exceptions = {};
  Job* job = nullptr;
};
void exchange_with_thread(OfThread& other) {
  std::swap(device_counts, other.counts);
  std::swap(exception_state(), other.exceptions);
  other.job = Job::exchange(other.job);
}

// A stack that grows beyond its end meets the guard, which may not be touched, and not another's memory.
class Stack {
 public:
  Stack()
      : memory_(mmap(nullptr, kGuard + kStack, PROT_READ | PROT_WRITE,
                     MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0)) {
    if (memory_ != MAP_FAILED && mprotect(memory_, kGuard, PROT_NONE) == 0) return;
    const int reason = errno;
    if (memory_ != MAP_FAILED) munmap(memory_, kGuard + kStack);
    throw Error::system(std::string("no memory for another job's stack: ") + std::strerror(reason));
  }
  ~Stack() { munmap(memory_, kGuard + kStack); }
  Stack(const Stack&) = delete;
  Stack& operator=(const Stack&) = delete;
  void* data() const { return static_cast<char*>(memory_) + kGuard; }

 private:
  void* memory_;
};

}  // namespace

struct Fibers::Fiber {
  Fibers* of = nullptr;
  int index = 0;
  Stack stack = {};
  ucontext_t here = {}, caller = {};
  OfThread of_thread = {};
  std::exception_ptr error = {};
  bool ended = false;
};

namespace {
thread_local void* beginning = nullptr;  // the fiber that begins to run
}

Fibers::Fibers() = default;
Fibers::~Fibers() = default;

void Fibers::begin() {
  Fiber& fiber = *static_cast<Fiber*>(beginning);
  try {
    (*fiber.of->job_)(fiber.index);
  } catch (...) {
    fiber.error = std::current_exception();
  }
  fiber.ended = true;
  fiber.of->switch_to_caller(fiber);
}

void Fibers::resume_fiber(Fiber& fiber) {
  current_ = fiber.index;
  beginning = &fiber;
  exchange_with_thread(fiber.of_thread);
  swapcontext(&fiber.caller, &fiber.here);
  current_ = -1;
}

void Fibers::switch_to_caller(Fiber& fiber) {
  exchange_with_thread(fiber.of_thread);
  swapcontext(&fiber.here, &fiber.caller);
}

void Fibers::wait() {
  switch_to_caller(*fiber_[current_]);
  if (failure_) std::rethrow_exception(failure_);
}

void Fibers::run(int count, const std::function<void(int)>& job, const std::function<void()>& all_wait) {
  job_ = &job;
  fiber_.clear();
  for (int i = 0; i < count; ++i) {
    fiber_.push_back(std::make_unique<Fiber>());
    Fiber& fiber = *fiber_.back();
    fiber.of = this;
    fiber.index = i;
    getcontext(&fiber.here);
    fiber.here.uc_stack = {.ss_sp = fiber.stack.data(), .ss_flags = 0, .ss_size = kStack};
    makecontext(&fiber.here, &Fibers::begin, 0);
  }
  for (bool all_ended = false; !all_ended;) {
    all_ended = true;
    for (const auto& fiber : fiber_) {
      if (!fiber->ended) resume_fiber(*fiber);
      all_ended = all_ended && fiber->ended;
    }
    try {
      all_wait();
    } catch (...) {
      failure_ = std::current_exception();
    }
  }
  for (const auto& fiber : fiber_)
    if (fiber->error) std::rethrow_exception(fiber->error);
  if (failure_) std::rethrow_exception(failure_);
}

}  // namespace hysteron
