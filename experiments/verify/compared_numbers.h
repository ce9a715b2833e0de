// Compares numbers of a run with those of its repetition, within the differences that they may have.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "experiments/diff/limits.h"
#include "experiments/workbench/app/manifest.h"

namespace hysteron::experiments {

// Numbers of one kind that both runs have, each in at most one list; numbers in no list are equal.
struct ComparedNumbers {
  int count = 0;
  std::vector<std::string> rounded;  // names of those that differ by no more than round-off
  std::vector<std::string> effort;   // names of differing numbers about the solver's work
  std::vector<std::string> within;   // texts on those that differ by no more than stated errors or limits
  std::vector<std::string> beyond;   // texts on those that differ by more

  std::size_t differing() const { return rounded.size() + effort.size() + within.size() + beyond.size(); }
  std::size_t same() const { return static_cast<std::size_t>(count) - differing(); }
  bool all_same() const { return differing() == 0; }
};

// Two numbers that are not equal, in one unit.
struct DifferingNumbers {
  std::string name;
  double before = 0, now = 0;
  double round_off = 0;           // difference allowed between builds, in their unit
  std::optional<double> limit{};  // from a file of limits, in their unit
  double stated_error = 0;        // error that --errors found, in their unit; 0 if none
  bool counts = false;            // whole numbers have no round-off
};
void compare_numbers(const DifferingNumbers& numbers, ComparedNumbers& found);

// Returns the scale of round-off: the number itself, or, if it is less, the full range of its kind: 100 % of
// a percentage, 1 of a ratio, 180 degrees of an angle, and 1/m of a curvature, below which cloth is flat.
double metric_scale(const std::string& name, double number);
// Returns the error of a metric that the run itself measured; 0 if it did not.
double stated_error(const Metrics& metrics, const std::string& name);

// True for durations and for metrics that depend on them, such as the fastest settings on the fronts of
// `accuracy`.
bool is_duration(const std::string& metric);
// True for the solver's work and its residuals, on a page also after a column's name, "prandtl.".  They are
// compared only if they have a limit.
bool is_effort(const std::string& metric);

}  // namespace hysteron::experiments
