#include "experiments/workbench/pages/gallery_folders.h"

#include <algorithm>

#include "experiments/workbench/app/experiment.h"
#include "experiments/workbench/app/manifest_file.h"
#include "experiments/workbench/pages/pictures.h"
#include "sim/base/error.h"

namespace hysteron::experiments {
namespace {
namespace fs = std::filesystem;

// As in --help; others follow in the order of their names.
std::ptrdiff_t catalogue_index(const std::string& name) {
  const auto& all = experiments();
  return std::find_if(all.begin(), all.end(), [&](const Experiment& e) { return name == e.name; }) -
         all.begin();
}

// A link to a folder through which it was reached has no last subfolder.
void throw_if_loop(const fs::path& folder) {
  std::error_code ignored;
  if (!fs::is_symlink(folder, ignored)) return;
  const fs::path target = fs::canonical(folder, ignored);
  for (fs::path above = folder.parent_path(); !above.empty(); above = above.parent_path()) {
    if (fs::canonical(above, ignored) == target)
      throw Error::invalid_input(folder.string() + " is a link back to " + above.string() + ": remove it");
    if (above == above.parent_path()) return;
  }
}

std::vector<fs::path> subfolders(const fs::path& folder) {
  std::vector<fs::path> found;
  std::error_code failure, ignored;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, failure)) {
    const std::string name = entry.path().filename().string();
    const bool sequence = name == "frames" || name.starts_with("frames-") || name == "film" || name == "mesh";
    if (!entry.is_directory(ignored) || name.starts_with('.') || sequence) continue;
    throw_if_loop(entry.path());
    found.push_back(entry.path());
  }
  if (failure) throw Error::system("cannot read the folder " + folder.string() + ": " + failure.message());
  std::sort(found.begin(), found.end());
  return found;
}

bool holds_anything(const Exhibit& exhibit) {
  const auto any = [&](const char* ending) { return !files_ending(exhibit.folder, ending).empty(); };
  return exhibit.manifest || any(".json") || any(".png") || any(".svg") || any(".csv") ||
         !files_ending(exhibit.folder / "frames", ".png").empty();
}

// `beside` receives the subfolders of a folder that is no run.
void collect(const fs::path& folder, const std::string& name, std::vector<Exhibit>& beside) {
  Exhibit exhibit{name, folder, {}, {}};
  if (const fs::path file = folder / "manifest.json"; is_there(file)) exhibit.manifest = read_manifest(file);
  for (const fs::path& sub : subfolders(folder))
    collect(sub, name + "/" + sub.filename().string(), exhibit.manifest ? exhibit.parts : beside);
  if (holds_anything(exhibit)) beside.push_back(std::move(exhibit));
}

}  // namespace

std::string Exhibit::experiment() const {
  if (manifest) return manifest->experiment;
  return name.substr(0, name.find_first_of("/-"));
}

bool Exhibit::has_pictures() const {
  const auto any = [](const Exhibit& part) { return part.has_pictures(); };
  return !files_ending(folder, ".png").empty() || std::any_of(parts.begin(), parts.end(), any);
}

std::vector<ExhibitGroup> exhibits_in(const fs::path& gallery) {
  std::vector<Exhibit> all;
  for (const fs::path& folder : subfolders(gallery)) collect(folder, folder.filename().string(), all);
  if (all.empty()) {
    throw Error::invalid_input("nothing to show in " + gallery.string() +
                               ": neither it nor its subfolders hold a manifest.json, pictures or tables");
  }
  std::stable_sort(all.begin(), all.end(), [](const Exhibit& a, const Exhibit& b) {
    const auto key = [](const Exhibit& e) {
      return std::tuple(catalogue_index(e.experiment()), e.experiment(), !e.has_pictures(), e.name);
    };
    return key(a) < key(b);
  });
  std::vector<ExhibitGroup> groups;
  for (Exhibit& exhibit : all) {
    const std::string experiment = exhibit.experiment();
    if (groups.empty() || groups.back().experiment != experiment) groups.push_back({experiment, {}});
    groups.back().exhibits.push_back(std::move(exhibit));
  }
  return groups;
}

}  // namespace hysteron::experiments
