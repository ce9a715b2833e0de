// One framing for pictures that stand beside each other.
#pragma once

#include <vector>

#include "experiments/workbench/compare/variants.h"

namespace hysteron::experiments {

// The flag --camera.box of what the cloth of any variant passes through; none where the experiment frames all
// alike, the line draws no pictures, or says itself what they frame.
std::vector<Flag> shared_framing(const CommandLine& line, const std::vector<Variant>& variants);

}  // namespace hysteron::experiments
