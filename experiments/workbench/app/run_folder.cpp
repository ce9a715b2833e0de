#include "experiments/workbench/app/run_folder.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <iostream>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "experiments/workbench/app/exit_status.h"
#include "experiments/workbench/app/json_file.h"
#include "experiments/workbench/app/manifest_file.h"
#include "experiments/workbench/app/same_request.h"
#include "experiments/workbench/app/set_aside.h"
#include "sim/base/atomic_file.h"
#include "sim/base/comma_list.h"
#include "sim/base/error.h"
#include "sim/base/job.h"

namespace hysteron::experiments {
namespace {
namespace fs = std::filesystem;

constexpr const char* kElsewhere = ": give another folder (--out)";

fs::path made(const fs::path& folder) {
  make_folders(folder);
  return folder;
}

// Returns the manifest of the earlier run.
std::optional<Manifest> run_before_in(const fs::path& folder) {
  const fs::path file = folder / kManifestFile;
  if (!stands(file)) return {};
  std::optional<Manifest> manifest;
  if (is_plain(file)) manifest = manifest_or_none(file);
  if (manifest) return manifest;
  const std::string damage = is_plain(file) ? json_damage(file) : "";
  if (!damage.empty())
    throw Error::invalid_input(file.string() + " is damaged: it " + damage +
                               ", and what its run has left is not known and not replaced" + kElsewhere +
                               ", or remove this file");
  throw Error::invalid_input(file.string() + " is not of a run and is not replaced" + kElsewhere);
}

bool is_within(const fs::path& inner, const fs::path& outer) {
  return std::mismatch(outer.begin(), outer.end(), inner.begin(), inner.end()).first == outer.end();
}

// Throws if a fabric file was edited since it was written, as it then is its editor's work.
void throw_if_edited(const std::optional<Manifest>& run, const fs::path& folder) {
  if (!run) return;
  for (const InputRecord& file : run->tables)
    if (file.file.ends_with(".toml") && !is_as_written(*run, folder, file.file))
      throw Error::invalid_input((folder / file.file).string() +
                                 " was edited after its run had written it, and is not replaced" +
                                 kElsewhere + ", or move this file");
}

// Throws if a file named by `text`, the value of `what`, "--loop", would be moved away before the run, or
// replaced by it.
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
    for (const std::string& text : split(flag.text())) throw_if_input(flag.name() + " ", text, folder, names);
  }
  for (const std::string& text : line.positionals) throw_if_input("", text, folder, names);
}

// Does the same for files that a scene or a study names.
void throw_if_read(const fs::path& folder, const std::vector<fs::path>& names,
                   const std::vector<std::string>& kept) {
  if (!Job::current()) return;
  for (const FileRead& read : Job::current()->files_read()) {
    const std::string name = fs::proximate(fs::weakly_canonical(read.file), fs::weakly_canonical(folder));
    if (!std::count(kept.begin(), kept.end(), name)) throw_if_input("", read.file, folder, names);
  }
}

// Returns the first folder of the path that does not exist; "" if all do.
fs::path first_missing(const fs::path& folder) {
  fs::path missing;
  for (fs::path path = fs::absolute(folder).lexically_normal(); !path.empty() && !stands(path);
       path = path.parent_path())
    missing = path;
  return missing;
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

// The state that outlives the object until the job has ended: only then is it known whether the request was
// refused.
struct RunFolder::Held {
  Held(const fs::path& path, const CommandLine& line)
      : path(path),
        missing(first_missing(path)),
        lock(made(path), ", or give another folder (--out)"),
        run_before(run_before_in(path)),
        aside(path, Successor::run) {
    throw_if_inputs(line, path, names());
    throw_if_edited(run_before, path);
  }

  // Returns the names of files that this run replaces when it is complete.
  std::vector<fs::path> names() const {
    std::vector<fs::path> all = recorded_files(run_before, path);
    const fs::path waiting = fs::proximate(aside.place(), path);
    for (const fs::path& name :
         recorded_files(manifest_or_none(aside.place() / kManifestFile), aside.place()))
      all.push_back(waiting / name);
    return all;
  }
  void settle(int exit_code);
  void take_back();

  fs::path path, missing;
  FolderLock lock;
  std::optional<Manifest> run_before;
  SetAside aside;
  std::vector<SetAside> parts;
  bool complete = false, stays = false;
};

// Restores everything as before the run, except parts that are complete and have replaced nothing: the
// corrected page reuses them with --resume.
void RunFolder::Held::take_back() {
  for (auto part = parts.rbegin(); part != parts.rend(); ++part) {
    if (part->has_new_complete_run()) continue;
    part->restore();
    remove_empty_folders(path, {fs::proximate(part->place(), path)});
  }
  aside.restore();
  // These folders were made for the run, and are removed if nobody else has written into them.
  std::error_code ignored;
  for (fs::path folder = fs::absolute(path).lexically_normal();
       !missing.empty() && is_within(folder, missing); folder = folder.parent_path())
    if (!fs::remove(folder, ignored)) return;
}

// A wrong request keeps the earlier run, and so does a machine that fails before there is a result.
void RunFolder::Held::settle(int exit_code) {
  if (complete) return;
  const bool nothing_since = aside.has_run() && !aside.has_results_since();
  if (!stays && (exit_code == kRefused || nothing_since)) {
    take_back();
    return;
  }
  for (SetAside& part : parts) part.keep_if_complete();
  aside.keep_if_complete();
  if (aside.has_complete_run())
    std::cerr << "the complete run before is kept in " << aside.place().string() << std::endl;
}

RunFolder::RunFolder(const fs::path& path, const CommandLine& line)
    : path_(path), held_(std::make_shared<Held>(path, line)) {}

RunFolder::~RunFolder() {
  if (held_->complete) return;
  if (Job* const job = Job::current())
    job->at_end([held = std::move(held_)](int exit_code) { held->settle(exit_code); });
}

void RunFolder::set_run_before_aside(const std::vector<std::string>& kept) {
  throw_if_read(path_, held_->names(), kept);
  held_->aside.move({kept.begin(), kept.end()});
}

void RunFolder::add_part(const fs::path& folder, bool goes_on) {
  SetAside& part = held_->parts.emplace_back(folder, Successor::page);
  if (goes_on) return;
  std::error_code ignored;
  std::optional<FolderLock> free;
  if (fs::is_directory(folder, ignored)) free.emplace(folder, ", or give another folder (--out)");
  part.move();
}

void RunFolder::keep_from_here() { held_->stays = true; }

void RunFolder::is_complete() {
  held_->complete = true;
  for (SetAside& part : held_->parts) part.remove();
  held_->aside.remove();
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

}  // namespace hysteron::experiments
