// Wall clock: what was measured, and what a table may take.
#pragma once

#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <string>

namespace hysteron::experiments {

class Stopwatch {
 public:
  // Since it was made [s].
  double seconds() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point start_ = Clock::now();
};

// Rows that would not fit are left out, and say so.
class Budget {
 public:
  explicit Budget(double seconds) : seconds_(seconds) {}

  // Why what is expected to take so long [s] is left out; "" if it fits.
  std::string refusal(double expected) const {
    const double left = std::max(seconds_ - clock_.seconds(), 0.0);
    if (expected < left) return "";
    if (left == 0) return fmt::format("the budget of {:.0f} s is used up", seconds_);
    return fmt::format("some {:.0f} s are needed, {:.0f} of {:.0f} s are left", expected, left, seconds_);
  }

 private:
  double seconds_;
  Stopwatch clock_;
};

}  // namespace hysteron::experiments
