#include "experiments/workbench/app/mesh_record.h"

#include <fmt/core.h>

#include <algorithm>
#include <optional>

#include "sim/base/fnv1a.h"
#include "sim/base/whole_file.h"
#include "sim/mesh/mesh_sequence.h"
#include "sim/scene/assets.h"
#include "sim/scene/mesh_files.h"

namespace hysteron::experiments {
namespace {
namespace fs = std::filesystem;

std::string mesh_hash(const fs::path& name) {
  std::vector<fs::path> files = files_like(name.string());
  if (files.empty()) files = {name};  // the name itself, which cannot be read
  std::uint64_t hash = kFnv1aStart;
  for (const fs::path& file : files) {
    const std::string bytes = whole_file(file, "cannot read mesh " + file.string());
    hash = fnv1a(bytes.data(), bytes.size(), hash);
  }
  return fmt::format("{:016x}", hash);
}

bool names_files(const fs::path& name) { return !files_like(name.string()).empty(); }

// Returns the first of folder/c.obj, folder/b/c.obj, ... for /a/b/c.obj that has the recorded bytes.
std::optional<fs::path> below(const fs::path& folder, const MeshRecord& record) {
  const fs::path path = fs::path(record.file).relative_path();
  fs::path tail;
  for (auto part = path.end(); part != path.begin();) {
    tail = tail.empty() ? *--part : *--part / tail;
    if (names_files(folder / tail) && mesh_hash(folder / tail) == record.hash) return folder / tail;
  }
  return {};
}

std::string found(const MeshRecord& record, const fs::path& manifest) {
  if (const fs::path shipped = asset_place(record.file); names_files(shipped)) return shipped.string();
  for (fs::path folder = fs::absolute(manifest).lexically_normal().parent_path();;
       folder = folder.parent_path()) {
    if (const auto moved = below(folder, record)) return moved->string();
    if (folder == folder.parent_path()) return record.file;
  }
}

// Finds the record by file, or else by key, because obstacles may have other numbers in a record than in the
// requested scene: an experiment adds its own.
const MeshRecord* record_of(const MeshFile& mesh, const std::vector<MeshRecord>& records) {
  const auto same_file = std::ranges::find(records, *mesh.path, &MeshRecord::file);
  if (same_file != records.end()) return &*same_file;
  const auto same_key = std::ranges::find(records, mesh.key, &MeshRecord::key);
  return same_key == records.end() ? nullptr : &*same_key;
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
        {mesh.key, asset_name(fs::absolute(*mesh.path).lexically_normal()), mesh_hash(*mesh.path)});
  return records;
}

void find_meshes(Scene& scene, const std::vector<MeshRecord>& records, const fs::path& manifest) {
  for (const MeshFile& mesh : mesh_files(scene))
    if (const MeshRecord* record = record_of(mesh, records)) *mesh.path = found(*record, manifest);
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
