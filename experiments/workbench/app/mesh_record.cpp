#include "experiments/workbench/app/mesh_record.h"

#include <fmt/core.h>

#include <optional>

#include "sim/base/fnv1a.h"
#include "sim/base/whole_file.h"
#include "sim/scene/mesh_files.h"

namespace hysteron::experiments {
namespace {
namespace fs = std::filesystem;

std::string file_hash(const fs::path& file) {
  const std::string bytes = whole_file(file, "cannot read mesh " + file.string());
  return fmt::format("{:016x}", fnv1a(bytes.data(), bytes.size()));
}

bool is_file(const fs::path& file) {
  std::error_code ignored;
  return fs::is_regular_file(file, ignored);
}

// Of /a/b/c.obj: folder/c.obj, folder/b/c.obj ..., if one of them has these bytes.
std::optional<fs::path> below(const fs::path& folder, const MeshRecord& record) {
  const fs::path path = fs::path(record.file).relative_path();
  fs::path tail;
  for (auto part = path.end(); part != path.begin();) {
    tail = tail.empty() ? *--part : *--part / tail;
    if (is_file(folder / tail) && file_hash(folder / tail) == record.hash) return folder / tail;
  }
  return {};
}

std::string found(const MeshRecord& record, const fs::path& manifest) {
  if (is_file(record.file)) return record.file;
  for (fs::path folder = fs::absolute(manifest).lexically_normal().parent_path();;
       folder = folder.parent_path()) {
    if (const auto moved = below(folder, record)) return moved->string();
    if (folder == folder.parent_path()) return record.file;
  }
}

}  // namespace

void make_mesh_paths_absolute(Scene& scene) {
  for (const MeshFile& mesh : mesh_files(scene))
    if (!mesh.path->empty()) *mesh.path = fs::absolute(*mesh.path).lexically_normal().string();
}

std::vector<MeshRecord> mesh_records(const Scene& scene) {
  Scene copy = scene;
  std::vector<MeshRecord> records;
  for (const MeshFile& mesh : mesh_files(copy))
    records.push_back(
        {mesh.key, fs::absolute(*mesh.path).lexically_normal().string(), file_hash(*mesh.path)});
  return records;
}

void find_meshes(Scene& scene, const std::vector<MeshRecord>& records, const fs::path& manifest) {
  for (const MeshFile& mesh : mesh_files(scene))
    for (const MeshRecord& record : records)
      if (record.key == mesh.key) *mesh.path = found(record, manifest);
}

std::vector<std::string> changed_meshes(const std::vector<MeshRecord>& recorded,
                                        const std::vector<MeshRecord>& now) {
  std::vector<std::string> changed;
  for (const MeshRecord& before : recorded)
    for (const MeshRecord& mesh : now)
      if (mesh.key == before.key && mesh.file == before.file && mesh.hash != before.hash)
        changed.push_back("mesh " + mesh.file + " (" + mesh.key +
                          ") has changed since it was recorded: hash " + mesh.hash + ", then " + before.hash);
  return changed;
}

}  // namespace hysteron::experiments
