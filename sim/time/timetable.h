// Tells when the steps of a run end, and which of these ends are nearest to instants at a given rate.
#pragma once

#include <vector>

#include "sim/time/simulation.h"

namespace hysteron {

// A run of steps that ends exactly when it is asked to.
class Timetable {
 public:
  // Takes steps of `step` up to `seconds` [s].  Unless these are a whole number of steps, the last step is
  // shorter; if it were shorter than half a step, the last two steps share what is left, because a step of a
  // few rounding errors cannot be solved.
  Timetable(double seconds, double step);
  // Takes steps of these lengths [s]; those that are longer than `step` are rests, each of which ends in an
  // instant.
  Timetable(std::vector<double> lengths, double step);

  long steps() const { return even_ + static_cast<long>(lengths_.size()); }
  // Returns the length of the step that follows `n` others [s].
  double length(long n) const { return n < even_ ? step_ : lengths_[n - even_]; }
  bool is_even(long n) const { return length(n) == step_; }
  // Returns the time after `n` steps [s].
  double time(long n) const { return n <= even_ ? n * step_ : times_[n - even_ - 1]; }
  // Returns the time from the end of step `from` to that of step `to` [s].
  double between(long from, long to) const;

  // Is the end of step `n` (0: the start) an instant at `rate` [1/s]? It is if no other is nearer to one of
  // k/rate, k = 0, 1, ...; so are the end of the run and the ends of rests.  A rate of 0 has no others.
  bool is_instant(long n, double rate) const;
  // Returns the first such step behind `n`.
  long next_instant(long n, double rate) const;
  // Returns the number of steps after which the time first reaches `time` [s], but for rounding; one more
  // than all steps if it never does.
  long first_end(double time) const;
  // Returns the largest distance of the instants at `rate` from k/rate [s].
  double largest_shift(double rate) const;

 private:
  // Returns how many of k/rate lie before the middle between the ends of step `n` and of the next one.
  double passed(long n, double rate) const;

  double step_;
  long even_ = 0;                // number of steps of `step_` that come first
  std::vector<double> lengths_;  // lengths of the steps behind them [s]
  std::vector<double> times_;    // at which these steps end [s]
};

// Takes the simulation's next steps, up to step `to`.  Throws as Simulation::advance() does.
void advance_along(const Timetable& timetable, Simulation& simulation, long to);

}  // namespace hysteron
