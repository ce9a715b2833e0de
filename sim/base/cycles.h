// A stretch of time that repeats, such as phases that a scene goes through several times.
#pragma once

#include <algorithm>
#include <cmath>

namespace hysteron {

// A timetable for [start, start + length] [s] holds again in each further cycle; its entries for later times
// hold once all cycles are over.
struct Cycles {
  double start = 0;   // [s]
  double length = 0;  // [s]
  int count = 1;

  bool repeat() const { return count > 1 && length > 0; }
  double once_over() const { return start + length; }                // end of the first cycle [s]
  double end_of(int cycle) const { return start + cycle * length; }  // the first is 1 [s]
  // Returns how many cycles are over at `time` [s]; negative before them.
  double over(double time) const {
    constexpr double kRounding = 1e-9;  // share of a cycle by which sums of steps miss its end
    return length > 0 ? std::floor((time - start) / length + kRounding) : -1;
  }
  // Returns the cycle that `time` [s] is in, the first being 1; 0 before and after them.
  int at(double time) const {
    const double past = over(time);
    return past >= 0 && past < count ? static_cast<int>(past) + 1 : 0;
  }
  // Returns the time in the timetable that applies at `time` [s].
  double said(double time) const {
    const double past = std::min(over(time), count - 1.0);
    return past > 0 ? std::max(start, time - past * length) : time;
  }
  // Returns when the timetable's entry for `time` first holds [s].
  double first(double time) const { return over(time) > 0 ? time + (count - 1) * length : time; }
};

}  // namespace hysteron
