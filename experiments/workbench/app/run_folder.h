// The folder that a run writes to: one run at a time, nothing outside it, nothing of others replaced.
#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "experiments/workbench/app/experiment.h"

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

class RunFolder {
 public:
  // Makes the folder, holds it and removes what the run before has left there: the files in its manifest and,
  // if it was interrupted, the rest of its sequences and files half written.  Throws Error::system;
  // Error::invalid_input where another run is in the folder, where its manifest.json is not a run's, and
  // where the line names one of those files as an input. `kept`: files of that run which are not removed,
  // since this one goes on from them.
  RunFolder(const std::filesystem::path& path, const CommandLine& line,
            const std::vector<std::string>& kept = {});

  const std::filesystem::path& path() const { return path_; }
  // Throws Error::invalid_input where place_for(name) would; of a sequence ("frames/0000.png") where any of
  // its files stands. `own`: those of this run.
  void check_free(const std::string& name, const std::set<std::string>& own) const;
  // Where to write the file of that name; its own folder is made.  Throws Error::invalid_input where
  // something stands there, which this run has not written, or where a link leads out of the folder.
  std::filesystem::path place_for(const std::string& name) const;

 private:
  void check_place(const std::filesystem::path& name) const;

  std::filesystem::path path_;
  FolderLock lock_;
};

// "frames/0012.png", one of a sequence, whose files are numbered.
bool is_numbered(const std::filesystem::path& name);

}  // namespace hysteron::experiments
