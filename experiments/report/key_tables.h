// The keys of scenes and the exit codes as tables in Markdown, written between two comments of a page of
// documentation.
#pragma once

#include "experiments/report/documentation.h"

namespace hysteron::experiments {

// A table for each kind of key (scene, [[pin]], [[obstacle]], keyframe, [[command]], [[phase]], [[metric]]),
// from the tables that reading, flags, --help and checks come from; fabrics and runs have theirs in --help.
std::string key_tables();

// A line for each exit code.
std::string exit_code_table();

// Writes key_tables() between `<!-- keys:begin -->` and `<!-- keys:end -->` of a page, and exit_code_table()
// between those of `exit-codes`.
void write_keys(Page& page);

}  // namespace hysteron::experiments
