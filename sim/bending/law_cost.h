// Time and memory of a law's loop alone, on elements whose curvatures jump about: histories with many
// reversals, the dearest kind.
#pragma once

#include "sim/bending/law_loop.h"

namespace hysteron {

struct LawCost {
  double ns_per_element = 0;     // of one commit, median over batches
  double bytes_per_element = 0;  // of history
};

// `dimension` 1 or 3.  Curvatures are spread over +-2 k0.
template <class Real, class Device>
LawCost law_cost(Device& device, const LawChoice& choice, int dimension, int elements);

}  // namespace hysteron
