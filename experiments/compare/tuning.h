// Tunes a number of a comparison's first column until one of its metrics equals one of the second.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "experiments/compare/plan.h"
#include "experiments/workbench/app/run.h"

namespace hysteron::experiments {

struct Tuning {
  std::string key;             // key of a scene or an experiment, a positive number: "fabric.damping"
  std::string low, high;       // ends of the bracket, as given
  std::string metric, target;  // metric of the first column, of the second
};

// Parses "fabric.damping=1e-5:1e-1" (compare.tune) and "viscous_J=bending_friction_J" (compare.tune-metric;
// a single name is the metric of both).  Throws Error::invalid_input.
Tuning parsed_tuning(const std::string& key_and_bracket, const std::string& metrics);

// Returns by how much the metric exceeds the target with that number.
using Excess = std::function<double(const std::string& number)>;

// Bisects the bracket in the logarithm kBisections times, to numbers of four significant digits, and returns
// the one that came nearest, as it was tried: if the metric jumps that need not be the last.  Throws
// Error::invalid_input if the excess has the same sign at both ends.
inline constexpr int kBisections = 9;  // narrows four decades to 1.8 %
std::string tuned(const Tuning& tuning, const Excess& excess);

// Throws for a wrong compare.tune of the choice, and what its first tries would refuse before their
// first step.
void check_tuning(const CommandLine& inner, const std::vector<Variant>& variants, const CompareParams& choice,
                  const Options& options);

// Tunes by the choice's compare.tune: the first two columns run without pictures in OUT/tries with each
// number, as parts of the page's run, then the first variant gets the number that came nearest, which goes to
// stdout, "fabric.damping=0.004839".  Warns of a miss of more than a percent.  Returns the manifest's
// entry.  Throws Error::invalid_input, Error::simulation if a try could not go on, and what running throws.
Json tune_first_column(Run& run, const CommandLine& inner, std::vector<Variant>& variants,
                       const CompareParams& choice, SweepJobs jobs, const Options& options);

}  // namespace hysteron::experiments
