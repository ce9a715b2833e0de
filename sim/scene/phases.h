// Times of a scene by the names of its phases.
#pragma once

#include <string>
#include <vector>

#include "sim/scene/scene.h"

namespace hysteron {

// When the named phase begins [s]; -1 if there is none of that name.
double phase_start(const std::vector<Phase>& phases, const std::string& name);
// Sum of all of them [s].
double phases_end(const std::vector<Phase>& phases);
// A time written as "hang", "hang + 0.2" or "hang - 0.2" (spaces as one likes) [s].  Error::request, which
// ends in `origin`, for a name that is no phase or a number that is none.
double time_of(const std::vector<Phase>& phases, const std::string& text, const std::string& origin);

}  // namespace hysteron
