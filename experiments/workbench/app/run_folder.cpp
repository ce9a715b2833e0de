#include "experiments/workbench/app/run_folder.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <set>
#include <vector>

#include "experiments/workbench/app/manifest_file.h"
#include "sim/base/comma_list.h"
#include "sim/base/error.h"

namespace hysteron::experiments {
namespace {
namespace fs = std::filesystem;

constexpr const char* kManifest = "manifest.json";
constexpr const char* kElsewhere = ": give another folder (--out)";

fs::path made(const fs::path& folder) {
  std::error_code failure;
  fs::create_directories(folder, failure);
  if (!failure && !fs::is_directory(folder, failure) && !failure)
    failure = std::make_error_code(std::errc::not_a_directory);
  if (failure) throw Error::system("cannot create the folder " + folder.string() + ": " + failure.message());
  return folder;
}

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

// One of the folders on the way from `folder` to the file of that name is a link.
bool is_behind_a_link(const fs::path& folder, const fs::path& name) {
  std::error_code ignored;
  fs::path path_part = folder;
  for (const fs::path& part : name.parent_path())
    if (fs::is_symlink(fs::symlink_status(path_part /= part, ignored))) return true;
  return false;
}

// The run before, by its manifest.
std::optional<Manifest> run_before(const fs::path& folder) {
  const fs::path file = folder / kManifest;
  if (!stands(file)) return {};
  std::optional<Manifest> manifest;
  if (is_plain(file)) manifest = manifest_or_none(file);
  if (!manifest)
    throw Error::invalid_input(file.string() + " is not of a run and is not replaced" + kElsewhere);
  return manifest;
}

// Names of its files, and of the page that `hysteron report` may have written since.
std::vector<fs::path> recorded_files(const std::optional<Manifest>& manifest, const fs::path& folder) {
  if (!manifest) return {};
  std::vector<fs::path> names = {"report.html"};
  for (const fs::path name : manifest->files)
    if (stays_inside(name) && !is_behind_a_link(folder, name)) names.push_back(name);
  return names;
}

// "metrics.csv" of "metrics.csv.part" and "metrics.csv.part-71-3"; "" of other names.
std::string half_written(const std::string& name) {
  const std::size_t part = name.rfind(".part");
  if (part == name.npos || part == 0) return "";
  const std::string end = name.substr(part + 5);
  return end.find_first_not_of("-0123456789") == end.npos ? name.substr(0, part) : "";
}

// "frames/0013.png" of "frames/0012.png".
fs::path next_in_sequence(const fs::path& name) {
  std::string digits = name.stem().string();
  const std::size_t grows = digits.find_last_not_of('9');
  if (grows == digits.npos) digits.insert(0, 1, '0');
  const std::size_t at = grows == digits.npos ? 0 : grows;
  ++digits[at];
  std::fill(digits.begin() + static_cast<std::ptrdiff_t>(at) + 1, digits.end(), '0');
  return name.parent_path() / (digits + name.extension().string());
}

// An interrupted run lists the first file of a sequence only: the others follow it without a gap, up to the
// one that was about to be written.  Files behind a gap are another's.
std::set<fs::path> with_their_sequences(const fs::path& folder, const std::vector<fs::path>& listed) {
  std::set<fs::path> names(listed.begin(), listed.end());
  for (const fs::path& first : listed)
    if (is_numbered(first))
      for (fs::path name = next_in_sequence(first); names.insert(name).second && stands(folder / name);)
        name = next_in_sequence(name);
  return names;
}

void remove_interrupted(const fs::path& folder, const std::vector<fs::path>& listed,
                        const std::set<fs::path>& kept) {
  std::set<fs::path> names = with_their_sequences(folder, listed), folders = {""};
  for (const fs::path& name : listed) folders.insert(name.parent_path());
  names.insert(kManifest);
  std::error_code ignored;
  for (const fs::path& inner : folders) {
    std::vector<fs::path> found;
    for (const auto& entry : fs::directory_iterator(folder / inner, ignored))
      found.push_back(inner / entry.path().filename());
    for (const fs::path& name : found) {
      const std::string target = half_written(name.filename().string());
      const bool left =
          target.empty() ? is_numbered(name) && names.contains(name) : names.contains(inner / target);
      if (left && !kept.contains(name) && is_plain(folder / name)) fs::remove(folder / name, ignored);
    }
  }
}

void remove_run(const std::optional<Manifest>& manifest, const fs::path& folder,
                const std::set<fs::path>& kept) {
  const std::vector<fs::path> names = recorded_files(manifest, folder);
  std::error_code ignored;
  for (const fs::path& name : names)
    if (!kept.contains(name) && is_plain(folder / name)) fs::remove(folder / name, ignored);
  if (manifest && !manifest->complete) remove_interrupted(folder, names, kept);
  for (const fs::path& name : names)
    if (name.has_parent_path() && fs::is_empty(folder / name.parent_path(), ignored))
      fs::remove(folder / name.parent_path(), ignored);
}

bool is_within(const fs::path& inner, const fs::path& outer) {
  return std::mismatch(outer.begin(), outer.end(), inner.begin(), inner.end()).first == outer.end();
}

// `what`, "--loop", names files: one of them would be removed before the run, or replaced by it.
void throw_if_input(const std::string& what, const std::string& text, const fs::path& folder,
                    const std::vector<fs::path>& names) {
  std::error_code missing;
  const fs::path input = fs::canonical(text, missing), whole = fs::weakly_canonical(folder);
  if (missing || !is_within(input, whole)) return;
  for (const fs::path& name : names)
    if (stands(whole / name) && is_within(whole / name, input))
      throw Error::invalid_input(what + text + " is of the run in " + folder.string() +
                                 ", which this one would replace" + kElsewhere);
}

void throw_if_inputs(const CommandLine& line, const fs::path& folder, const std::vector<fs::path>& names) {
  for (const Flag& flag : line.flags) {
    if (flag.path == "out") continue;
    for (const std::string& text : split(flag.text))
      throw_if_input("--" + flag.path + " ", text, folder, names);
  }
  for (const std::string& text : line.positionals) throw_if_input("", text, folder, names);
}

}  // namespace

FolderLock::FolderLock(const fs::path& folder, const std::string& otherwise)
    : handle_(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
  if (handle_ < 0)
    throw Error::system("cannot open the folder " + folder.string() + ": " + std::strerror(errno));
  if (::flock(handle_, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK) return;
  ::close(handle_);
  throw Error::invalid_input(folder.string() + " is in use by another run: wait for its end" + otherwise)
      .with_key("out", folder.string());
}

FolderLock::~FolderLock() { ::close(handle_); }

RunFolder::RunFolder(const fs::path& path, const CommandLine& line, const std::vector<std::string>& kept)
    : path_(made(path)), lock_(path, ", or give another folder (--out)") {
  const std::optional<Manifest> before = run_before(path_);
  throw_if_inputs(line, path_, recorded_files(before, path_));
  remove_run(before, path_, {kept.begin(), kept.end()});
}

void RunFolder::check_place(const fs::path& name) const {
  const fs::path file = path_ / name;
  if (!stays_inside(name) || is_behind_a_link(path_, name))
    throw Error::invalid_input(file.string() + " would be written outside " + path_.string() + kElsewhere);
  if (stands(file))
    throw Error::invalid_input(file.string() + " is not of an earlier run and is not replaced" + kElsewhere);
}

void RunFolder::check_free(const std::string& name, const std::set<std::string>& own) const {
  if (!own.contains(name)) check_place(name);
  const fs::path inner = fs::path(name).parent_path();
  if (inner.empty()) return;
  if (stands(path_ / inner) && !fs::is_directory(path_ / inner))
    throw Error::invalid_input((path_ / inner).string() + " must be a folder" + kElsewhere);
  if (!is_numbered(name)) return;
  std::error_code none;
  for (const auto& entry : fs::directory_iterator(path_ / inner, none)) {
    const fs::path other = inner / entry.path().filename();
    const bool same = is_numbered(other) && other.extension() == fs::path(name).extension();
    if (same && !own.contains(other.generic_string())) check_place(other);
  }
}

fs::path RunFolder::place_for(const std::string& name) const {
  check_place(name);
  const fs::path file = path_ / name;
  made(file.parent_path());
  return file;
}

bool is_numbered(const fs::path& name) {
  const std::string stem = name.stem().string();
  return stem.size() >= 4 && stem.find_first_not_of("0123456789") == stem.npos;
}

}  // namespace hysteron::experiments
