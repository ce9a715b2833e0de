// How much each uncertain number of a fabric moves its drape, from the drapes of a spread.
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

// Over the whole of a number's range, the others being anywhere in theirs.
struct NumberEffect {
  std::string number;  // "bias-bending"
  double low, high;    // of its range
  double change;       // of the drape coefficient from low to high [%]
  double error;        // standard error of that [%]
};

struct NumberEffects {
  std::vector<NumberEffect> effects;  // the largest first; empty where the drapes are too few
  double scatter = 0;                 // standard deviation that the numbers do not explain: meshes, folds [%]
  std::size_t drapes = 0, needed = 0;  // that there are, and from which on effects are sought
};

// Least squares of the drape coefficients [%] on the logarithms of the numbers, which a Latin hypercube has
// drawn alike in their logarithms.  drawn: by number, one value > 0 for each drape; ranges: of those numbers.
// Needs at least twice as many drapes as coefficients, so that the scatter is known, too.
NumberEffects number_effects(const std::map<std::string, std::vector<double>>& drawn,
                             const std::map<std::string, Range>& ranges,
                             const std::vector<double>& coefficients);

// Before the name of a number in spread.csv whose drapes were told otherwise (keep_what_was_measured()).
inline constexpr const char* kDrawn = "drawn ";
// The same of the rows of spread.csv that are of this fabric, for each of its uncertain numbers that the
// table has, as it was drawn.
NumberEffects effects_of_spread(const Table& spread, const FabricFile& file);

using EffectsByFabric = std::vector<std::pair<std::string, NumberEffects>>;

// effects.csv of those that have some; metrics and a line of the last, which says where drapes are too few.
void note_effects(Run& run, const EffectsByFabric& all);

// The change of each number with its standard error, a colour for each fabric; without series where no fabric
// has drapes enough.
render::Plot effects_plot(const EffectsByFabric& all);

}  // namespace hysteron::experiments
