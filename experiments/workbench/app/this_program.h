// Which program this is: what a manifest says of the one that wrote it.
#pragma once

#include <string>

#include "experiments/workbench/app/manifest.h"

namespace hysteron::experiments {

// A manifest with what is known of the program and nothing else.
Manifest this_program();

// The build ID that the linker has made of all that it linked; without one a hash of the executable.  Commits
// do not tell two builds of a modified tree apart.
const std::string& program_build();

// "another program made it (0.1.0 (commit 1f3a...))", where results of that manifest may not be this
// program's own; "": they are.
std::string program_change(const Manifest& before);

}  // namespace hysteron::experiments
