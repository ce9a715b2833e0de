// A TOML file as a tree that remembers source lines; the only door to the TOML library.
#pragma once

#include <string>

#include "sim/scene/value_tree.h"

namespace hysteron {

// Reads a whole file.  Throws Error::system if it cannot be read, Error::invalid_input with file and line if
// it is no TOML, nests deeper than any scene, or holds what no key can take (dates, mixed arrays).
ValueTree read_toml(const std::string& file, Lists lists = Lists::refused);

}  // namespace hysteron
