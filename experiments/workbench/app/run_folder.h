// The folder that a run writes to: it holds one run at a time, which writes nothing outside it and replaces
// no file of others.
#pragma once

#include <filesystem>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "experiments/workbench/app/experiment.h"
#include "experiments/workbench/app/run_files.h"

namespace hysteron::experiments {

// Locks a folder until the object is destroyed or the process ends, in whatever way.  The lock is the
// kernel's (flock), on the folder itself: it leaves no file.  On file systems without such locks, nothing is
// locked.
class FolderLock {
 public:
  // Throws Error::invalid_input, naming the folder and what else can be done (`otherwise`), if another
  // process holds it.
  explicit FolderLock(const std::filesystem::path& folder, const std::string& otherwise = "");
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  int handle_;
};

// Manages the files of an earlier run, which wait beside the new one until that is complete (set_aside.h).
// How the job ends decides what happens to both:
//   complete                  the earlier run is removed
//   refused (exit code 2)     the folder is restored, byte for byte; a page's complete runs stay
//                             where there were none before
//   otherwise                 the new run keeps what it has written, and an earlier complete one stays
//                             in OUT/.before; without any result of the new one the folder is restored
class RunFolder {
 public:
  // Makes the folder and locks it; nothing in it is touched.  Throws Error::system; Error::invalid_input if
  // another run is in the folder, if its manifest.json is not a run's, or if the line names one of that run's
  // files as an input.
  RunFolder(const std::filesystem::path& path, const CommandLine& line);
  ~RunFolder();
  RunFolder(const RunFolder&) = delete;
  RunFolder& operator=(const RunFolder&) = delete;

  // Sets the earlier run aside except `kept`, files of an interrupted run from which this one goes on.
  // Throws Error::invalid_input if the job has read one of the others, Error::system.
  void set_run_before_aside(const std::vector<std::string>& kept);
  // Adds a folder inside this one for a run that this one, a page, has started; unless the page goes on with
  // what it finds there, that is set aside like its own files.  Throws Error::invalid_input if another run is
  // in it.
  void add_part(const std::filesystem::path& folder, bool goes_on);
  // From here on written files stay, even if the request turns out to be wrong.
  void keep_from_here();
  void is_complete();

  const std::filesystem::path& path() const { return path_; }
  // Throws Error::invalid_input where place_for(name) would; for a sequence ("frames/0000.png") if any of its
  // files exists.  `own` are those of this run.
  void check_free(const std::string& name, const std::set<std::string>& own) const;
  // Returns the path for the file of that name; its own folder is made.  Throws Error::invalid_input if
  // something is there that this run has not written, or if a link leads out of the folder.
  std::filesystem::path place_for(const std::string& name) const;

 private:
  void check_place(const std::filesystem::path& name) const;

  struct Held;

  std::filesystem::path path_;
  std::shared_ptr<Held> held_;
};

}  // namespace hysteron::experiments
