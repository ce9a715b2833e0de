#include "render/png_writer.h"

#include <algorithm>
#include <ctime>
#include <utility>

namespace hysteron::render {
namespace {

double thread_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

int worker_count(int requested) {
  return requested > 0 ? requested : std::max(1, static_cast<int>(std::thread::hardware_concurrency()) / 2);
}

}  // namespace

PngWriter::PngWriter(int threads, int capacity) : capacity_(static_cast<size_t>(std::max(1, capacity))) {
  for (int i = 0; i < worker_count(threads); ++i) workers_.emplace_back([this] { work(); });
}

PngWriter::~PngWriter() {
  {
    const std::lock_guard lock(mutex_);
    closing_ = true;
  }
  changed_.notify_all();
  workers_.clear();  // joins before the queue is destroyed
}

void PngWriter::write(std::filesystem::path path, Image image, PngEffort effort) {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return waiting_.size() < capacity_ || first_error_; });
  throw_first_error();
  waiting_.push_back({std::move(path), std::move(image), effort});
  changed_.notify_all();
}

void PngWriter::finish() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return waiting_.empty() && in_progress_ == 0; });
  throw_first_error();
}

double PngWriter::encode_seconds() const {
  const std::lock_guard lock(mutex_);
  return encode_seconds_;
}

void PngWriter::throw_first_error() const {
  if (first_error_) std::rethrow_exception(first_error_);
}

void PngWriter::work() {
  std::unique_lock lock(mutex_);
  while (true) {
    changed_.wait(lock, [this] { return !waiting_.empty() || closing_; });
    if (waiting_.empty()) return;
    const Job job = std::move(waiting_.front());
    waiting_.pop_front();
    ++in_progress_;
    changed_.notify_all();
    lock.unlock();
    perform(job);
    lock.lock();
    --in_progress_;
    changed_.notify_all();
  }
}

void PngWriter::perform(const Job& job) {
  const double begin = thread_seconds();
  std::exception_ptr error;
  try {
    write_png(job.path, job.image, job.effort);
  } catch (...) {
    error = std::current_exception();
  }
  const std::lock_guard lock(mutex_);
  encode_seconds_ += thread_seconds() - begin;
  if (error && !first_error_) first_error_ = error;
}

}  // namespace hysteron::render
