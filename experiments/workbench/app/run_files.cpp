#include "experiments/workbench/app/run_files.h"

#include <algorithm>

#include "sim/base/error.h"
#include "sim/base/whole_file.h"

namespace hysteron::experiments {
namespace {
namespace fs = std::filesystem;

// Returns "metrics.csv" for "metrics.csv.part" and "metrics.csv.part-71-3"; "" for other names.
std::string half_written(const std::string& name) {
  const std::size_t part = name.rfind(".part");
  if (part == name.npos || part == 0) return "";
  const std::string end = name.substr(part + 5);
  return end.find_first_not_of("-0123456789") == end.npos ? name.substr(0, part) : "";
}

// Returns "frames/0013.png" for "frames/0012.png".
fs::path next_in_sequence(const fs::path& name) {
  std::string digits = name.stem().string();
  const std::size_t grows = digits.find_last_not_of('9');
  if (grows == digits.npos) digits.insert(0, 1, '0');
  const std::size_t at = grows == digits.npos ? 0 : grows;
  ++digits[at];
  std::fill(digits.begin() + static_cast<std::ptrdiff_t>(at) + 1, digits.end(), '0');
  return name.parent_path() / (digits + name.extension().string());
}

// Adds the files of sequences.  An interrupted run lists the first file of each only: the others follow it
// without a gap, up to the one that was about to be written.  Files behind a gap belong to others.
std::set<fs::path> with_their_sequences(const fs::path& folder, const fs::path& beside,
                                        const std::vector<fs::path>& listed) {
  const auto is_there = [&](const fs::path& name) {
    return stands(folder / name) || (!beside.empty() && stands(beside / name));
  };
  std::set<fs::path> names(listed.begin(), listed.end());
  for (const fs::path& first : listed)
    if (is_numbered(first))
      for (fs::path name = next_in_sequence(first); names.insert(name).second && is_there(name);)
        name = next_in_sequence(name);
  return names;
}

// Adds what an interrupted run has left beyond the list in its manifest.
void add_interrupted(const fs::path& folder, const fs::path& beside, const std::vector<fs::path>& listed,
                     std::set<fs::path>& left) {
  std::set<fs::path> names = with_their_sequences(folder, beside, listed), folders = {""};
  for (const fs::path& name : listed) folders.insert(name.parent_path());
  names.insert(kManifestFile);
  std::error_code ignored;
  for (const fs::path& inner : folders) {
    for (const auto& entry : fs::directory_iterator(folder / inner, ignored)) {
      const fs::path name = inner / entry.path().filename();
      const std::string target = half_written(name.filename().string());
      const bool is_left =
          target.empty() ? is_numbered(name) && names.contains(name) : names.contains(inner / target);
      if (is_left && is_plain(folder / name)) left.insert(name);
    }
  }
}

}  // namespace

bool stands(const fs::path& file) {
  std::error_code ignored;
  return fs::exists(fs::symlink_status(file, ignored));
}

bool is_plain(const fs::path& file) {
  std::error_code ignored;
  return fs::is_regular_file(fs::symlink_status(file, ignored));
}

bool stays_inside(const fs::path& name) {
  return name.is_relative() && !name.empty() && std::find(name.begin(), name.end(), "..") == name.end();
}

bool is_behind_a_link(const fs::path& folder, const fs::path& name) {
  std::error_code ignored;
  fs::path path_part = folder;
  for (const fs::path& part : name.parent_path())
    if (fs::is_symlink(fs::symlink_status(path_part /= part, ignored))) return true;
  return false;
}

bool is_numbered(const fs::path& name) {
  const std::string stem = name.stem().string();
  return stem.size() >= 4 && stem.find_first_not_of("0123456789") == stem.npos;
}

std::vector<fs::path> recorded_files(const std::optional<Manifest>& manifest, const fs::path& folder) {
  if (!manifest) return {};
  std::vector<fs::path> names = {"report.html", kOutcomeFile};
  for (const fs::path name : manifest->files)
    if (stays_inside(name) && !is_behind_a_link(folder, name)) names.push_back(name);
  return names;
}

std::set<fs::path> files_left(const std::optional<Manifest>& manifest, const fs::path& folder,
                              const fs::path& beside) {
  const std::vector<fs::path> listed = recorded_files(manifest, folder);
  std::set<fs::path> left;
  for (const fs::path& name : listed)
    if (is_plain(folder / name)) left.insert(name);
  if (manifest && !manifest->complete) add_interrupted(folder, beside, listed, left);
  return left;
}

void remove_files(const fs::path& folder, const std::set<fs::path>& names) {
  std::error_code ignored;
  for (const fs::path& name : names) fs::remove(folder / name, ignored);
  remove_empty_folders(folder, {names.begin(), names.end()});
}

void remove_empty_folders(const fs::path& folder, const std::vector<fs::path>& names) {
  std::error_code ignored;
  for (const fs::path& name : names)
    for (fs::path inner = name.parent_path(); !inner.empty(); inner = inner.parent_path())
      if (fs::is_empty(folder / inner, ignored)) fs::remove(folder / inner, ignored);
}

bool has_mark(const fs::path& file, const std::string& mark) {
  std::error_code ignored;
  return fs::is_regular_file(file, ignored) && whole_file(file).find(mark) != std::string::npos;
}

void require_own_file(const fs::path& file, const std::string& mark, const std::string& what,
                      const std::string& key) {
  std::error_code ignored;
  if (!fs::is_regular_file(file, ignored) || fs::file_size(file, ignored) == 0) return;
  if (has_mark(file, mark)) return;
  const Error refused = Error::invalid_input((key.empty() ? "" : "--" + key + " ") + file.string() +
                                             " is a file that is there already and is not " + what +
                                             " of this program: give another name, or remove it");
  throw key.empty() ? refused : refused.with_key(key, file.string());
}

}  // namespace hysteron::experiments
