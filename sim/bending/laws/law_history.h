// How much a law remembers in a cloth.
#pragma once

#include "sim/bending/laws/law_parameters.h"

namespace hysteron {

// Numbers of history of one element; `dimension` 1 (hinge) or 3 (shape).
int history_size(const LawChoice& choice, int dimension);

}  // namespace hysteron
