// A mesh file's bytes.
#pragma once

#include <string>

namespace hysteron {

// The whole file.  Throws Error::machine, naming it.
std::string read_mesh_text(const std::string& file);

}  // namespace hysteron
