#include "sim/scene/mesh_files.h"

#include "sim/mesh/file_ending.h"

namespace hysteron {
namespace {

bool takes_a_file(const ClothShape& cloth) { return cloth.shape == "file" || cloth.shape == "pattern"; }

}  // namespace

std::string rest_file(const Scene& scene) {
  if (names_an_obj(scene.mesh)) return scene.mesh;
  return takes_a_file(scene.cloth) ? scene.cloth.file : "";
}

std::vector<MeshFile> mesh_files(Scene& scene) {
  std::vector<MeshFile> files;
  if (names_an_obj(scene.mesh))
    files.push_back({"mesh", &scene.mesh});
  else if (takes_a_file(scene.cloth))
    files.push_back({"cloth.file", &scene.cloth.file});
  if (names_an_obj(scene.cloth.start)) files.push_back({"cloth.start", &scene.cloth.start});
  return files;
}

}  // namespace hysteron
