// The OBJs that a scene's cloth is read from.
#pragma once

#include <string>
#include <vector>

#include "sim/scene/scene.h"

namespace hysteron {

// Of the cloth at rest; "" of one that is built.
std::string rest_file(const Scene& scene);

// The keys that name OBJs which are read, and where their paths stand.
struct MeshFile {
  const char* key;
  std::string* path;
};
std::vector<MeshFile> mesh_files(Scene& scene);

}  // namespace hysteron
