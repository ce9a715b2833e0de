// How stiff the contact shell is.
#pragma once

#include "sim/scene/scene.h"

namespace hysteron {

// Normal penalty stiffness per area [N/m^3]: the scene's, or that at which the cloth's own weight sinks 1e-4
// of its thickness into the shell.
double contact_stiffness_per_area(const Scene& scene);

}  // namespace hysteron
