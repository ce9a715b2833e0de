// Measures seconds per stage of a step.  On the GPU stages are timed by events, which the host reads only
// when it asks for the totals, so that timing does not stop the device.
#pragma once

#include <array>
#include <chrono>
#include <vector>

#include "sim/base/archive.h"
#include "sim/device/device.h"

namespace hysteron {

enum class Stage { membrane, bending, solve, contact, history, count };
inline constexpr int kStages = static_cast<int>(Stage::count);
inline constexpr const char* kStageName[kStages] = {"membrane", "bending", "solve", "contact", "history"};
using StageSeconds = std::array<double, kStages>;

template <class Device>
class StageClock;

template <>
class StageClock<Cpu> {
 public:
  explicit StageClock(Cpu&) {}
  void begin(Stage) { start_ = std::chrono::steady_clock::now(); }
  void end(Stage stage) {
    seconds_[static_cast<int>(stage)] +=
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }
  StageSeconds seconds() { return seconds_; }
  void add(const StageSeconds& seconds) {
    for (int s = 0; s < kStages; ++s) seconds_[s] += seconds[s];
  }

 private:
  std::chrono::steady_clock::time_point start_;
  StageSeconds seconds_{};
};

#ifdef __CUDACC__
template <>
class StageClock<Cuda> {
 public:
  explicit StageClock(Cuda& cuda) : cuda_(cuda) {}
  ~StageClock() {
    for (cudaEvent_t event : event_) cudaEventDestroy(event);
  }
  void begin(Stage) { record(); }
  void end(Stage stage) {
    record();
    if (cuda_.batch) return;
    stage_.push_back(stage);
    if (stage_.size() == kPending) collect();
  }
  StageSeconds seconds() {
    collect();
    return seconds_;
  }
  void add(const StageSeconds& seconds) {
    for (int s = 0; s < kStages; ++s) seconds_[s] += seconds[s];
  }

 private:
  static constexpr std::size_t kPending = 2048;  // timed stages before the host has to read them
  void record() {
    if (cuda_.batch) return;  // launches of a batch are not one member's
    if (used_ == event_.size()) {
      event_.emplace_back();
      check_cuda(cudaEventCreate(&event_.back()), "stage clock");
    }
    check_cuda(cudaEventRecord(event_[used_++], cuda_.stream), "stage clock");
  }
  void collect() {
    cuda_.synchronize();
    for (std::size_t i = 0; i < stage_.size(); ++i) {
      float milliseconds = 0;
      check_cuda(cudaEventElapsedTime(&milliseconds, event_[2 * i], event_[2 * i + 1]), "stage clock");
      seconds_[static_cast<int>(stage_[i])] += 1e-3 * milliseconds;
    }
    stage_.clear();
    used_ = 0;
  }
  Cuda& cuda_;
  std::vector<cudaEvent_t> event_;
  std::vector<Stage> stage_;
  std::size_t used_ = 0;
  StageSeconds seconds_{};
};
#endif

// A resumed run goes on counting.
template <class Device>
void serialise(Archive& archive, StageClock<Device>& clock) {
  StageSeconds seconds{};
  if (!archive.loads()) seconds = clock.seconds();
  archive(seconds);
  if (archive.loads()) clock.add(seconds);
}

}  // namespace hysteron
