#include "sim/time/timetable.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace hysteron {
namespace {

// The share of a step by which a duration may miss a whole number of steps that its decimals meant.
constexpr double kRounding = 1e-4;

// Returns the sums of the lengths, from `time` on [s].
std::vector<double> ends(const std::vector<double>& lengths, double time) {
  std::vector<double> result;
  for (const double length : lengths) result.push_back(time += length);
  return result;
}

}  // namespace

Timetable::Timetable(double seconds, double step) : step_(step) {
  const double count = seconds / step, whole = std::round(count);
  if (std::abs(count - whole) <= kRounding) {
    even_ = std::lround(whole);
    return;
  }
  even_ = static_cast<long>(std::floor(count));
  const double left = count - static_cast<double>(even_);  // in steps
  if (left < 0.5 && even_ > 0) {
    --even_;
    lengths_.assign(2, (1 + left) / 2 * step);
  } else {
    lengths_ = {left * step};
  }
  times_ = ends(lengths_, static_cast<double>(even_) * step);
}

Timetable::Timetable(std::vector<double> lengths, double step)
    : step_(step), lengths_(std::move(lengths)), times_(ends(lengths_, 0)) {}

double Timetable::between(long from, long to) const {
  const long from_even = std::min(from, even_), to_even = std::min(to, even_);
  double sum = static_cast<double>(to_even - from_even) * step_;
  for (long n = std::max(from, even_); n < to; ++n) sum += length(n);
  return sum;
}

double Timetable::passed(long n, double rate) const {
  if (n < 0) return 0;
  return std::ceil((time(n) + time(n + 1)) / 2 * rate);
}

bool Timetable::is_instant(long n, double rate) const {
  if (n == 0 || n == steps()) return true;
  if (length(n - 1) > step_) return true;
  return passed(n, rate) > passed(n - 1, rate);
}

long Timetable::next_instant(long n, double rate) const {
  do ++n;
  while (n < steps() && !is_instant(n, rate));
  return n;
}

long Timetable::first_end(double at) const {
  long n = 0;
  while (n <= steps() && time(n) < at - kRounding * step_) ++n;
  return n;
}

double Timetable::largest_shift(double rate) const {
  if (rate <= 0) return 0;
  double largest = 0;
  for (long n = 1; n < steps(); ++n) {
    if (passed(n, rate) <= passed(n - 1, rate)) continue;
    const double k = std::round(time(n) * rate);
    largest = std::max(largest, std::abs(time(n) - k / rate));
  }
  return largest;
}

void advance_along(const Timetable& timetable, Simulation& simulation, long to) {
  const long from = simulation.steps();
  long even = from;  // up to here, steps of the scene's length follow one another
  while (even < to && timetable.is_even(even)) ++even;
  if (even > from) simulation.advance(static_cast<int>(even - from));
  for (long n = even; n < to; ++n) {
    if (timetable.is_even(n))
      simulation.advance(1);
    else
      simulation.advance_by(timetable.length(n));
  }
}

}  // namespace hysteron
