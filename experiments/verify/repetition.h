// A run beside its repetition: what is the same, and what is not.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/diff/limits.h"
#include "experiments/workbench/app/manifest.h"

namespace hysteron::experiments {

// How far the two agree.
enum class Agreement { bits, errors, none };

struct Repetition {
  bool has_state = false;               // positions and velocities were hashed
  bool same_state = false;              // and are the same, bit for bit
  bool bits_are_due = false;            // other bits are a failure
  int metrics = 0;                      // numbers that both have
  double round_off = 0;                 // what may lie between two builds, of a number's size
  std::vector<std::string> rounded;     // metrics that differ by no more than that, by name
  std::vector<std::string> effort;      // that say how steps were solved, and differ, by name
  std::vector<std::string> within;      // that differ by no more than stated errors or limits, in words
  std::vector<std::string> beyond;      // that differ by more, in words
  std::vector<std::string> missing;     // that are no longer measured: a difference
  std::vector<std::string> unrecorded;  // that are measured, and the manifest does not hold: likewise
  int pictures = 0;
  std::vector<std::string> pictures_beyond;  // in words

  Agreement agreement() const;
};

// Builds for other instruction sets, and other versions of the mathematical library, round the last bits
// differently.  What becomes of that: a step ends wherever its forces balance to `newton-residual` of the
// load, and last bits decide where.  Short of chaos and of snaps a tenth of that tolerance is
// enough, and runs without such steps stay within 1e-6.  (Measured on a dozen quick runs, without fused
// multiplication in the mathematical library and with the simulation built for AVX-512: at most 2e-5 where
// the tolerance is 1e-3, but 1.03e-4 of the integrator's share in `crease --quick`; 5e-8 where it is 1e-6.)
double round_off_bound(const Manifest& run);
// What round-off is a share of: the number itself, or, if it is less, the whole of what has one: 100 % of a
// percentage, 1 of a ratio, half a turn of an angle; and 1/m of a curvature, below which cloth is flat.
double metric_scale(const std::string& name, double number);

// Numbers are compared exactly, then with the limits of `limits` or else the errors that --errors has stated
// of them, then with round-off; counts, texts and truths exactly.  What only one of them has is a difference,
// but for what a newer program measures besides, and for the errors themselves, which are not repeated.  How
// often a solver iterated, and what it left over, says nothing of the cloth and is only counted.  Durations
// are not compared.
//
// The same bits are due where one compiler's same instructions ran on the same device, and where `exact` asks
// for them.
Repetition compare_runs(const Manifest& recorded, const Manifest& now, const Limits& limits, bool exact);
// Pictures that both folders have.  Plots are none: they belong to gnuplot's version.
void compare_pictures(const std::vector<std::string>& names, const std::filesystem::path& recorded,
                      const std::filesystem::path& now, const Limits& limits, Repetition& repetition);
// Those of a run that are still in its folder.
std::vector<std::string> pictures_in(const Manifest& recorded, const std::filesystem::path& folder);

// What else differs between the two and may be why: program, device, keys of the scene; "" for nothing.
std::string reasons_between(const Manifest& recorded, const Manifest& now);

}  // namespace hysteron::experiments
