// A run beside its repetition: what is the same, and what is not.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/workbench/app/manifest.h"

namespace hysteron::experiments {

struct Comparison {
  bool has_state = false;            // positions and velocities were hashed
  bool same_state = false;           // and are the same, bit for bit
  int metrics = 0;                   // numbers that both have
  std::vector<std::string> within;   // metrics that differ by no more than their stated errors, in words
  std::vector<std::string> beyond;   // and those that differ by more, or state none
  std::vector<std::string> missing;  // that are no longer measured
  int pictures = 0;
  std::vector<std::string> pictures_beyond;  // in words

  bool is_same() const {
    return same_state == has_state && within.empty() && beyond.empty() && pictures_beyond.empty();
  }
};

// Numbers are compared exactly, then with the errors that --errors has stated of them; durations of wall
// clock are not compared.
Comparison compare_runs(const Manifest& recorded, const Manifest& now);
// Pictures that both folders have, with the limits of the golden pictures in tests/golden: last bits differ
// between processors and renderers.  Plots are none: they belong to gnuplot's version.
void compare_pictures(const std::vector<std::string>& names, const std::filesystem::path& recorded,
                      const std::filesystem::path& now, Comparison& comparison);
// Those of a run that are still in its folder.
std::vector<std::string> pictures_in(const Manifest& recorded, const std::filesystem::path& folder);

// What else differs between the two and may be why: program, device, keys of the scene; "" for nothing.
std::string reasons_between(const Manifest& recorded, const Manifest& now);

}  // namespace hysteron::experiments
