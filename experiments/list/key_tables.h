// The keys of scene files as tables in Markdown.
#pragma once

#include <string>

namespace hysteron::experiments {

// A table for each kind of key (scene, [[pin]], [[obstacle]], keyframe, [[command]], [[phase]], [[metric]]),
// from the tables that reading, flags, --help and checks come from; fabrics and runs have theirs in --help.
std::string key_tables();

}  // namespace hysteron::experiments
