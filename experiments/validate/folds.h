// Fold counts of drapes against those of real cloth: a coefficient alone does not tell whether a drape looks
// like one.
#pragma once

#include "experiments/validate/drapes.h"

namespace hysteron::experiments {

// What was counted on real drapes of one fabric.
struct RealDrapes {
  double coefficient, deviation;  // mean and standard deviation [%]
  int fewest, most;               // folds
};

// Of ten fabrics, 300 mm on 180 mm: Gong, Mao, Wang 2024, a public set of meshes of 584 drapes of 25 fabrics,
// outlines counted with a prominence of 3 mm.  By rising coefficient.
const std::vector<RealDrapes>& real_drapes();

// The range of folds that real drapes of this coefficient [%] have: between those of the two fabrics around
// it.
struct FoldRange {
  double fewest, most;
};
FoldRange real_folds(double coefficient);

// plot_folds: each drape's coefficient and folds over the ranges of real ones; metrics: of each fabric the
// share of its drapes within.
void compare_folds(Run& run, const std::vector<Drape>& drapes, bool pictures);

}  // namespace hysteron::experiments
