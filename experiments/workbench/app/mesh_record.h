// Records the mesh files of a run, so that it can be repeated with the same ones from wherever its manifest
// is read.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace hysteron {
struct Scene;
}

namespace hysteron::experiments {

struct MeshRecord {
  std::string key;   // key that names it: "cloth.file"
  std::string file;  // absolute path, or a pattern for several files; assets/... for shipped ones
  std::string hash;  // hash of its bytes, or of all files together
};

// Makes the paths of the scene's mesh files absolute, independent of the working directory.
void make_mesh_paths_absolute(Scene& scene);

// Throws Error::system for files that cannot be read.
std::vector<MeshRecord> mesh_records(const Scene& scene);

// Lets the scene of a manifest name the files that are recorded there: at their recorded place or, if they
// are gone, the same bytes below a folder above the manifest, as when both were moved together.
void find_meshes(Scene& scene, const std::vector<MeshRecord>& records, const std::filesystem::path& manifest);

// Returns a sentence for each recorded file that the scene still names and whose bytes have changed.
std::vector<std::string> changed_meshes(const std::vector<MeshRecord>& recorded,
                                        const std::vector<MeshRecord>& now);

}  // namespace hysteron::experiments
