// When the steps of a run end, and which of these ends are nearest to instants that come at a rate.
#pragma once

#include <vector>

#include "sim/time/simulation.h"

namespace hysteron {

// A run of steps that ends exactly when it is asked to.
class Timetable {
 public:
  // Steps of `step` up to `seconds` [s].  Where that is no whole number of steps, the last step is shorter;
  // where less than half a step would be left, the last two steps share what is left, because a step of a
  // few rounding errors cannot be solved.
  Timetable(double seconds, double step);
  // Steps of these lengths; those that are longer than `step` are rests, each of which ends in an instant
  // [s].
  Timetable(std::vector<double> lengths, double step);

  long steps() const { return even_ + static_cast<long>(lengths_.size()); }
  // Length of the step that follows `n` others [s].
  double length(long n) const { return n < even_ ? step_ : lengths_[n - even_]; }
  bool is_even(long n) const { return length(n) == step_; }
  // Time after `n` steps [s].
  double time(long n) const { return n <= even_ ? n * step_ : times_[n - even_ - 1]; }
  // From the end of step `from` to that of step `to` [s].
  double between(long from, long to) const;

  // Whether the end of step `n` (0: the start) is an instant at `rate` [1/s]: no other is nearer to one of
  // k/rate, k = 0, 1, ...; so are the end of the run and the ends of rests.  A rate of 0 has no others.
  bool is_instant(long n, double rate) const;
  // The first such step behind `n`.
  long next_instant(long n, double rate) const;
  // The number of steps after which the time is first not before this one but for rounding [s]; one more than
  // there are where none is.
  long first_end(double time) const;
  // By how much the instants at `rate` lie beside k/rate, at most [s].
  double largest_shift(double rate) const;

 private:
  // How many of k/rate lie before the middle between the ends of step `n` and of the next one.
  double passed(long n, double rate) const;

  double step_;
  long even_ = 0;                // steps of `step_` that come first
  std::vector<double> lengths_;  // of those behind them [s]
  std::vector<double> times_;    // at which these end [s]
};

// Takes the steps that follow the simulation's, up to step `to`.  Throws what Simulation::advance() does.
void advance_along(const Timetable& timetable, Simulation& simulation, long to);

}  // namespace hysteron
