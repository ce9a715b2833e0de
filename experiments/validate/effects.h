// Estimates how much each uncertain number of a fabric moves its drape, from the drapes of a spread.
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "experiments/workbench/app/run.h"
#include "render/plot.h"
#include "sim/base/csv.h"
#include "sim/scene/fabric_reader.h"

namespace hysteron::experiments {

// The effect over the whole of a number's range, with the others anywhere in theirs.
struct NumberEffect {
  std::string number;  // name of the number: "bias-bending"
  double low, high;    // ends of its range
  double change;       // change of the drape coefficient from low to high [%]
  double error;        // standard error of the change [%]
};

struct NumberEffects {
  std::vector<NumberEffect> effects;   // the largest first; empty if there are too few drapes
  double scatter = 0;                  // standard deviation left by the numbers: meshes, folds [%]
  std::size_t drapes = 0, needed = 0;  // their number, and the number from which effects are estimated
};

// Fits the drape coefficients [%] by least squares to the logarithms of the numbers, which a Latin hypercube
// has drawn uniformly in their logarithms.  `drawn` has, by number, one value > 0 for each drape; `ranges`
// those numbers' ranges.  At least twice as many drapes as coefficients are needed, so that the scatter is
// known, too.
NumberEffects number_effects(const std::map<std::string, std::vector<double>>& drawn,
                             const std::map<std::string, Range>& ranges,
                             const std::vector<double>& coefficients);

// The prefix in spread.csv of a drawn number that drapes received converted (keep_what_was_measured()).
inline constexpr const char* kDrawn = "drawn ";
// Estimates the effects from the rows of spread.csv that are of this fabric, for each of its uncertain
// numbers in the table, as it was drawn.
NumberEffects effects_of_spread(const Table& spread, const FabricFile& file);

using EffectsByFabric = std::vector<std::pair<std::string, NumberEffects>>;

// Writes effects.csv of fabrics with effects; adds metrics and a line for the last fabric, which reports too
// few drapes.
void note_effects(Run& run, const EffectsByFabric& all);

// Plots the change of each number with its standard error, a colour for each fabric; without series if no
// fabric has enough drapes.
render::Plot effects_plot(const EffectsByFabric& all);

}  // namespace hysteron::experiments
