// PNG files written beside the simulation: encoding one takes several times as long as drawing it on a GPU.
#pragma once

#include <condition_variable>
#include <deque>
#include <exception>
#include <filesystem>
#include <mutex>
#include <thread>
#include <vector>

#include "render/image.h"

namespace hysteron::render {

class PngWriter {
 public:
  // `threads` is the number of workers, 0 for half the cores, at least one.  `capacity` pictures may wait;
  // then write() waits too, so that a slow disk bounds memory instead of filling it.
  explicit PngWriter(int threads = 0, int capacity = 8);
  // Waits for all pictures handed over; errors are lost then: call finish() to see them.
  ~PngWriter();
  PngWriter(const PngWriter&) = delete;
  PngWriter& operator=(const PngWriter&) = delete;

  // Hands a picture over.  Throws the first error of an earlier one, so that a run on a full disk stops soon.
  void write(std::filesystem::path path, Image image, PngEffort effort = PngEffort::fast);
  // Waits until everything is on disk and throws the first error.
  void finish();

  // Processor time of all workers spent on encoding and writing [s].
  double encode_seconds() const;

 private:
  struct Job {
    std::filesystem::path path;
    Image image;
    PngEffort effort;
  };

  void work();
  void perform(const Job& job);
  void throw_first_error() const;

  const size_t capacity_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Job> waiting_;
  int in_progress_ = 0;
  double encode_seconds_ = 0;
  bool closing_ = false;
  std::exception_ptr first_error_;
  std::vector<std::jthread> workers_;
};

}  // namespace hysteron::render
