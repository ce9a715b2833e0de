// Lists the files that a scene's cloth and its bodies of triangles are read from.
#pragma once

#include <string>
#include <vector>

#include "sim/scene/scene.h"

namespace hysteron {

// Returns the file of the cloth at rest; "" if the cloth is built.
std::string rest_file(const Scene& scene);

// Keys that name mesh files, "cloth.file" or "obstacle[0].sequence", and where their paths stand; a sequence
// may be a pattern of several (files_like(), mesh/mesh_sequence.h).
struct MeshFile {
  std::string key;
  std::string* path;
};
std::vector<MeshFile> mesh_files(Scene& scene);

}  // namespace hysteron
