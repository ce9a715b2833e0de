// One framing for pictures that stand beside each other.
#pragma once

#include <vector>

#include "experiments/workbench/compare/variants.h"

namespace hysteron::experiments {

// The flag --camera.box of what the cloth of any variant passes through; none where the experiment frames all
// alike, the line draws no pictures, or says itself what they frame.
std::vector<Flag> shared_framing(const CommandLine& line, const std::vector<Variant>& variants);

// Flags of columns whose pictures are cells of a page: without letters and, where they show cloth and the
// line does not say otherwise, on white.
std::vector<Flag> for_sheets(const CommandLine& line);

}  // namespace hysteron::experiments
