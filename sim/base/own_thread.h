// An object that lives on a thread of its own: an OpenGL context belongs to one thread, and drawing there
// goes on beside what the caller computes.
#pragma once

#include <condition_variable>
#include <exception>
#include <functional>
#include <future>
#include <memory>
#include <mutex>
#include <thread>
#include <type_traits>
#include <utility>

namespace hysteron {

// `Owned` is made, used and destroyed on that thread.  One caller at a time.
template <class Owned>
class OwnThread {
 public:
  using Job = std::function<void(Owned&)>;

  // Throws what `make` throws.  The destructor finishes the posted job, whose errors are lost: call wait() to
  // see them.
  explicit OwnThread(std::function<std::unique_ptr<Owned>()> make)
      : job_([this, make = std::move(make)] { owned_ = make(); }),
        worker_([this](const std::stop_token& stop) { work(stop); }) {
    wait();
  }
  OwnThread(const OwnThread&) = delete;
  OwnThread& operator=(const OwnThread&) = delete;

  // Starts `job` on that thread and returns at once, or as soon as an earlier one is done.  Throws what the
  // earlier one threw; `job` is not done then.
  void post(Job job) {
    std::unique_lock lock(mutex_);
    wait_until_idle(lock);
    job_ = [this, job = std::move(job)] { job(*owned_); };
    lock.unlock();
    changed_.notify_all();
  }
  // Waits for the posted job and throws what it threw.
  void wait() {
    std::unique_lock lock(mutex_);
    wait_until_idle(lock);
  }
  // Posts `body`, waits for it and returns its result.
  template <class Body>
  auto run(const Body& body) -> std::invoke_result_t<Body, Owned&> {
    std::packaged_task<std::invoke_result_t<Body, Owned&>(Owned&)> task(std::cref(body));
    post([&task](Owned& owned) { task(owned); });
    wait();
    return task.get_future().get();
  }

 private:
  void wait_until_idle(std::unique_lock<std::mutex>& lock) {
    changed_.wait(lock, [this] { return job_ == nullptr; });
    if (error_) std::rethrow_exception(std::exchange(error_, nullptr));
  }

  void work(const std::stop_token& stop) {
    std::unique_lock lock(mutex_);
    while (changed_.wait(lock, stop, [this] { return job_ != nullptr; })) {
      lock.unlock();
      std::exception_ptr error;
      try {
        job_();
      } catch (...) {
        error = std::current_exception();
      }
      lock.lock();
      error_ = error;
      job_ = nullptr;
      changed_.notify_all();
    }
    owned_.reset();
  }

  std::mutex mutex_;
  std::condition_variable_any changed_;
  std::function<void()> job_;  // empty: idle
  std::exception_ptr error_;
  std::unique_ptr<Owned> owned_;
  std::jthread worker_;  // the last, so that it ends first
};

}  // namespace hysteron
