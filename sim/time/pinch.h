// Cloth between solids that close on it, or between one and a pin or other layers.
#pragma once

#include "sim/time/body.h"

namespace hysteron {

// Counts a part of a step that ends at `time` with vertices in solids [s]: as pinched where something presses
// them from the other side, as deep where a blow has driven one in.
template <class Real, class Device>
void count_overlap(Body<Real, Device>& body, double time);
// Likewise a stage in which bodies of triangles have yielded.
template <class Real, class Device>
void count_dents(Body<Real, Device>& body);

}  // namespace hysteron
