// Numbers of a run beside those of its repetition, and how far they may differ.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "experiments/diff/limits.h"
#include "experiments/workbench/app/manifest.h"

namespace hysteron::experiments {

// Numbers of one kind that both runs have, each in one list at most; those in none are equal.
struct ComparedNumbers {
  int count = 0;
  std::vector<std::string> rounded;  // differ by no more than round-off, by name
  std::vector<std::string> effort;   // say how steps were solved, and differ, by name
  std::vector<std::string> within;   // differ by no more than stated errors or limits, in words
  std::vector<std::string> beyond;   // differ by more, in words

  std::size_t differing() const { return rounded.size() + effort.size() + within.size() + beyond.size(); }
  std::size_t same() const { return static_cast<std::size_t>(count) - differing(); }
  bool all_same() const { return differing() == 0; }
};

// Two numbers that are not equal, in one unit.
struct DifferingNumbers {
  std::string name;
  double before = 0, now = 0;
  double round_off = 0;           // difference that builds may have, in their unit
  std::optional<double> limit{};  // of a file of limits, in their unit
  double stated_error = 0;        // that --errors has found, in their unit; 0: none
  bool counts = false;            // whole numbers are not rounded
};
void compare_numbers(const DifferingNumbers& numbers, ComparedNumbers& found);

// What round-off is a share of: the number itself, or, if it is less, the whole of what has one: 100 % of a
// percentage, 1 of a ratio, half a turn of an angle; and 1/m of a curvature, below which cloth is flat.
double metric_scale(const std::string& name, double number);
// As the run itself has measured the errors of a metric; 0 where it has not.
double stated_error(const Metrics& metrics, const std::string& name);

// A duration, or what goes by durations: on `accuracy`'s fronts stand the settings that take least.
bool is_duration(const std::string& metric);
// The solver's work and what it left over; on a page behind a column's name, "prandtl.".  It is held to a
// limit that is set on it, and to nothing else.
bool is_effort(const std::string& metric);

}  // namespace hysteron::experiments
