#include "experiments/workbench/app/set_aside.h"

#include <algorithm>
#include <utility>

#include "experiments/workbench/app/manifest_file.h"
#include "experiments/workbench/app/run_files.h"
#include "sim/base/error.h"

namespace hysteron::experiments {
namespace {
namespace fs = std::filesystem;

constexpr const char* kBefore = ".before";
constexpr const char* kStopped = ".stopped";
constexpr const char* kPageBefore = ".page-before";
constexpr const char* kPageStopped = ".page-stopped";

void move_file(const fs::path& from, const fs::path& to) {
  std::error_code failure;
  fs::create_directories(to.parent_path(), failure);
  if (!failure) fs::rename(from, to, failure);
  if (failure)
    throw Error::system("cannot move " + from.string() + " to " + to.string() + ": " + failure.message());
}

void remove_if_empty(const fs::path& folder) {
  std::error_code ignored;
  if (fs::is_empty(folder, ignored)) fs::remove(folder, ignored);
}

// Removes the run that waits there and nothing else in that folder.  A continued run has kept the first files
// of its sequences in its own folder.
void remove_waiting(const fs::path& slot) {
  const auto manifest = manifest_or_none(slot / kManifestFile);
  if (!manifest) return;
  std::set<fs::path> names = files_left(manifest, slot, slot.parent_path());
  names.insert(kManifestFile);
  remove_files(slot, names);
  remove_if_empty(slot);
}

void check_slot(const fs::path& slot) {
  std::error_code ignored;
  const fs::file_status status = fs::symlink_status(slot, ignored);
  if (fs::exists(status) && !fs::is_directory(status))
    throw Error::invalid_input(slot.string() +
                               " must be a folder, where an earlier run waits: give another folder (--out)");
}

}  // namespace

bool is_set_aside(const fs::path& folder) {
  const fs::path name = folder.filename();
  return name == kBefore || name == kStopped || name == kPageBefore || name == kPageStopped;
}

SetAside::SetAside(fs::path folder, Successor successor)
    : folder_(std::move(folder)),
      before_name_(successor == Successor::run ? kBefore : kPageBefore),
      stopped_name_(successor == Successor::run ? kStopped : kPageStopped) {}

void SetAside::move(const std::set<fs::path>& kept) {
  has_begun_ = true;
  kept_ = kept;
  const auto manifest = manifest_or_none(folder_ / kManifestFile);
  if (!manifest) return;
  slot_ = folder_ / (manifest->complete ? before_name_ : stopped_name_);
  check_slot(slot_);
  remove_waiting(slot_);
  const std::set<fs::path> names = files_left(manifest, folder_);
  try {
    for (const fs::path& name : names) {
      if (kept_.contains(name)) continue;
      move_file(folder_ / name, slot_ / name);
      moved_.push_back(name);
    }
    // The manifest is moved last: until then the folder is that of the run, whatever happens to this process.
    move_file(folder_ / kManifestFile, slot_ / kManifestFile);
    moved_.emplace_back(kManifestFile);
  } catch (const Error&) {
    restore();  // moves back what was moved so far
    throw;
  }
  remove_empty_folders(folder_, moved_);
}

bool SetAside::has_new_complete_run() const {
  const auto manifest = manifest_or_none(folder_ / kManifestFile);
  return slot_.empty() && manifest && manifest->complete;
}

bool SetAside::has_complete_run() const {
  const auto waiting = manifest_or_none(place() / kManifestFile);
  return waiting && waiting->complete;
}

std::set<fs::path> SetAside::files_since() const {
  std::set<fs::path> names = files_left(manifest_or_none(folder_ / kManifestFile), folder_);
  std::erase_if(names, [&](const fs::path& name) { return kept_.contains(name); });
  return names;
}

bool SetAside::has_results_since() const { return !files_since().empty(); }

void SetAside::restore() {
  if (!std::exchange(has_begun_, false)) return;
  std::error_code ignored;
  const bool is_moved = std::ranges::find(moved_, kManifestFile) != moved_.end();
  const auto since = manifest_or_none(folder_ / kManifestFile);
  // If nothing was moved yet, the manifest in the folder is not the successor's.
  if (since && (is_moved || slot_.empty())) {
    std::set<fs::path> names = files_since();
    names.insert(kManifestFile);
    remove_files(folder_, names);
    remove_empty_folders(folder_, recorded_files(since, folder_));
  }
  for (const fs::path& name : moved_) {
    fs::create_directories((folder_ / name).parent_path(), ignored);
    fs::rename(slot_ / name, folder_ / name, ignored);
  }
  if (slot_.empty()) return;
  remove_empty_folders(slot_, moved_);
  remove_if_empty(slot_);
}

void SetAside::remove() {
  remove_waiting(folder_ / before_name_);
  remove_waiting(folder_ / stopped_name_);
}

void SetAside::keep_if_complete() { remove_waiting(folder_ / stopped_name_); }

}  // namespace hysteron::experiments
