// How much of a drape is known: with the fabric's uncertain numbers anywhere in their ranges, and along both
// paths on several meshes.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "experiments/validate/predictions.h"
#include "sim/scene/fabric_reader.h"

namespace hysteron::experiments {

// Numbers of a fabric by their keys.
using Sample = std::map<std::string, double>;

// A Latin hypercube of the fabric's ranges (McKay, Beckman & Conover 1979): each number once in each of
// `count` parts of its range that are equal in the logarithm, which part with which by chance.  b1 follows k0
// such that the friction moment (b1 - b2) k0/2 stays.
std::vector<Sample> samples_of(const FabricFile& file, int count, unsigned seed);

// As a drape is told of it, with all bits.
std::vector<Flag> flags_of(const Sample& sample);

// The first law, lowered, for each fabric with `samples` draws of its uncertain numbers, each on another
// mesh: spread.csv, plot_spread.
std::vector<Prediction> predict_spread(const ValidateFlags& flags, Run& run);

// The first law for each fabric along both paths on `draws` meshes: draws.csv.
std::vector<Prediction> predict_draws(const ValidateFlags& flags, Run& run);

}  // namespace hysteron::experiments
