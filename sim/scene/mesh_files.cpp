#include "sim/scene/mesh_files.h"

#include "sim/mesh/file_extension.h"
#include "sim/scene/body.h"

namespace hysteron {
std::string rest_file(const Scene& scene) {
  if (names_an_obj(scene.mesh)) return scene.mesh;
  return scene.cloth.is_of_file() ? scene.cloth.file : "";
}

std::vector<MeshFile> mesh_files(Scene& scene) {
  std::vector<MeshFile> files;
  if (names_an_obj(scene.mesh))
    files.push_back({"mesh", &scene.mesh});
  else if (scene.cloth.is_of_file())
    files.push_back({"cloth.file", &scene.cloth.file});
  if (names_an_obj(scene.cloth.start)) files.push_back({"cloth.start", &scene.cloth.start});
  for (std::size_t i = 0; i < scene.obstacle.size(); ++i) {
    Obstacle& o = scene.obstacle[i];
    if (!is_body(o)) continue;
    const std::string path = "obstacle[" + std::to_string(i) + "].";
    files.push_back({path + "file", &o.file});
    if (!o.sequence.empty()) files.push_back({path + "sequence", &o.sequence});
  }
  return files;
}

}  // namespace hysteron
