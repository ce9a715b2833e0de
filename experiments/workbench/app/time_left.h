// How long a run will take yet.
#pragma once

#include <string>

namespace hysteron::experiments {

// "  12 s left", "  3 min left", "  1 h 5 min left", by the `seconds` that `done` of `all` steps have taken;
// "" before a few steps and after the last.  `at_most`: the run may end earlier, at rest.
std::string time_left(long done, long all, double seconds, bool at_most);

}  // namespace hysteron::experiments
