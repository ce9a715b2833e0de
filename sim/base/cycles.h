// A stretch of time that is gone through several times.
#pragma once

#include <algorithm>
#include <cmath>

namespace hysteron {

// What is said of the times from `start` to `start + length` [s] holds again in each further cycle, and what
// is said of later times holds once all cycles are over.
struct Cycles {
  double start = 0;
  double length = 0;
  int count = 1;

  bool repeat() const { return count > 1 && length > 0; }
  double once_over() const { return start + length; }                // end of the first cycle [s]
  double end_of(int cycle) const { return start + cycle * length; }  // the first is 1 [s]
  // How many cycles are over at `time` [s]; negative before them.
  double over(double time) const {
    constexpr double kRounding = 1e-9;  // of a cycle, by which sums of steps miss its end
    return length > 0 ? std::floor((time - start) / length + kRounding) : -1;
  }
  // The cycle that `time` [s] is in, the first being 1; 0 before and after them.
  int at(double time) const {
    const double past = over(time);
    return past >= 0 && past < count ? static_cast<int>(past) + 1 : 0;
  }
  // The time that says what holds at `time` [s].
  double said(double time) const {
    const double past = std::min(over(time), count - 1.0);
    return past > 0 ? std::max(start, time - past * length) : time;
  }
  // When what is said of `time` first holds [s].
  double first(double time) const { return over(time) > 0 ? time + (count - 1) * length : time; }
};

}  // namespace hysteron
