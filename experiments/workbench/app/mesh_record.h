// The mesh files of a run, so that it is repeated with the same ones from wherever its manifest is read.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace hysteron {
struct Scene;
}

namespace hysteron::experiments {

struct MeshRecord {
  std::string key;   // that names it: "cloth.file"
  std::string file;  // absolute path, or a pattern of several
  std::string hash;  // of its bytes; of several of all of them
};

// Where the scene's mesh files are, however the working directory changes.
void make_mesh_paths_absolute(Scene& scene);

// Throws Error::system for files that cannot be read.
std::vector<MeshRecord> mesh_records(const Scene& scene);

// Lets the scene of a manifest name the files that are recorded there: where they were, or, if they are not
// there any more, the same bytes below a folder above the manifest, as where both were moved together.
void find_meshes(Scene& scene, const std::vector<MeshRecord>& records, const std::filesystem::path& manifest);

// A sentence for each recorded file that the scene still names and whose bytes have changed.
std::vector<std::string> changed_meshes(const std::vector<MeshRecord>& recorded,
                                        const std::vector<MeshRecord>& now);

}  // namespace hysteron::experiments
