// A scene as Python has it.
#pragma once

#include "python/values.h"
#include "sim/scene/scene.h"

namespace hysteron::python {

// Error::invalid_input unless it can be simulated.
const Scene& checked(const Scene& scene);

}  // namespace hysteron::python
