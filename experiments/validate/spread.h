// How much of a drape is known, with the fabric's uncertain numbers anywhere in their ranges.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "experiments/validate/validate.h"
#include "experiments/workbench/app/run.h"
#include "sim/scene/fabric_reader.h"

namespace hysteron::experiments {

// Numbers of a fabric by their keys.
using Sample = std::map<std::string, double>;

// A Latin hypercube of the fabric's ranges (McKay, Beckman & Conover 1979): each number once in each of
// `count` parts of its range that are equal in the logarithm, which part with which by chance.  B, 2HB or the
// friction moment stay as published, the mean of warp and weft; the range of bias-bending is that of its
// ratio to that mean.
std::vector<Sample> fabric_samples(const FabricFile& file, int count, unsigned seed);

// What is published holds for a sample: the friction moment for each k0, and B and 2HB as the mean of warp
// and weft. A range of bias-bending is that of its ratio to the mean of both.
void keep_what_was_measured(const Fabric& fabric, Sample& sample);

double mean_value(const std::vector<double>& values);
// Standard deviation of one, of at least two.
double sample_deviation(const std::vector<double>& values);

// As a drape is told of it, with all bits.
std::vector<Flag> drape_flags(const Sample& sample);

// Each fabric on its tester with `samples` draws of its uncertain numbers, each on another mesh: spread.csv,
// plot_spread, and beside what was measured predictions.csv.
void predict_spread(const ValidateFlags& flags, Run& run);

}  // namespace hysteron::experiments
