// The folder that a run writes to: one run at a time, nothing outside it, nothing of others replaced.
#pragma once

#include <filesystem>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "experiments/workbench/app/experiment.h"
#include "experiments/workbench/app/run_files.h"

namespace hysteron::experiments {

// Holds a folder until it is destroyed or the process ends, in whatever way.  The lock is the kernel's
// (flock), on the folder itself: it leaves no file.  Where the file system has no such locks, nothing is
// held.
class FolderLock {
 public:
  // Throws Error::invalid_input, naming the folder, where another one holds it; `otherwise`: what else can be
  // done.
  explicit FolderLock(const std::filesystem::path& folder, const std::string& otherwise = "");
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  int handle_;
};

// What stood there of an earlier run waits beside the new one until that is complete (set_aside.h).  How the
// job ends decides what becomes of both:
//   complete                  the earlier run is removed
//   refused (exit code 2)     the folder is again what it was, byte for byte; a page's complete runs stay
//                             where there were none before
//   otherwise                 the new run keeps what it has written, and an earlier one that was complete
//   stays
//                             in OUT/.before; without any result of the new one the folder is what it was
class RunFolder {
 public:
  // Makes the folder and holds it; nothing in it is touched.  Throws Error::system; Error::invalid_input
  // where another run is in the folder, where its manifest.json is not a run's, and where the line names one
  // of that run's files as an input.
  RunFolder(const std::filesystem::path& path, const CommandLine& line);
  ~RunFolder();
  RunFolder(const RunFolder&) = delete;
  RunFolder& operator=(const RunFolder&) = delete;

  // `kept`: files of an interrupted run which stay, since this one goes on from them.  Throws
  // Error::invalid_input where the job has read one of those that do not, Error::system.
  void set_run_before_aside(const std::vector<std::string>& kept);
  // A folder inside of a run that this one, a page, has started; where the page does not go on with what it
  // finds there, that is set aside like its own files.  Throws Error::invalid_input where another run is in
  // it.
  void add_part(const std::filesystem::path& folder, bool goes_on);
  // From here on what was written stays, even if the request turns out to be wrong.
  void keep_from_here();
  void is_complete();

  const std::filesystem::path& path() const { return path_; }
  // Throws Error::invalid_input where place_for(name) would; of a sequence ("frames/0000.png") where any of
  // its files stands. `own`: those of this run.
  void check_free(const std::string& name, const std::set<std::string>& own) const;
  // Where to write the file of that name; its own folder is made.  Throws Error::invalid_input where
  // something stands there, which this run has not written, or where a link leads out of the folder.
  std::filesystem::path place_for(const std::string& name) const;

 private:
  void check_place(const std::filesystem::path& name) const;

  struct Held;

  std::filesystem::path path_;
  std::shared_ptr<Held> held_;
};

}  // namespace hysteron::experiments
