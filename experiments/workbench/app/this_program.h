// Identifies this program for the manifests that it writes.
#pragma once

#include <string>

#include "experiments/workbench/app/manifest.h"

namespace hysteron::experiments {

// Returns a manifest with the description of the program and nothing else.
Manifest this_program();

// Returns the build ID that the linker has made of all that it linked, or a hash of the executable.  Commits
// do not distinguish two builds of a modified tree.
const std::string& program_build();

// Returns "another program made it (0.1.0 (commit 1f3a...))" if results of that manifest may differ from this
// program's; "" otherwise.
std::string program_change(const Manifest& before);

}  // namespace hysteron::experiments
