// Counts vertices of cloth between solids that close on it, or between a solid and a pin or other layers.
#pragma once

#include "sim/time/body.h"

namespace hysteron {

// Counts a part of a step, once, of which a stage ends at `time` [s] with vertices in solids: as pinched
// where something presses them from the other side, as deep where a blow has driven one in.
template <class Real, class Device>
void count_overlap(Body<Real, Device>& body, double time);
// Counts likewise a part in which bodies of triangles have yielded.
template <class Real, class Device>
void count_dents(Body<Real, Device>& body);

}  // namespace hysteron
