// Tracks one command line while it is answered: which files it has read, and what is settled when it ends.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <mutex>
#include <string>
#include <string_view>
#include <unordered_set>
#include <vector>

namespace hysteron {

struct FileRead {
  std::filesystem::path file;  // its name as the user gave it
  std::uint64_t hash;          // hash of its bytes when it was first read
};

// The job of a thread.  A process has one, or one for each of the runs that share it.  Every file that a user
// names passes whole_file(), which enters it here, so that no reader can forget to say what it has read.
class Job {
 public:
  // Becomes the job of this thread until it is destroyed; the job before it waits.
  Job();
  ~Job();
  Job(const Job&) = delete;
  Job& operator=(const Job&) = delete;

  // Is null where there is no job, as in other programs that use the library.
  static Job* current() { return current_; }
  // Gives this thread or fiber another job to work for and returns the one it had.
  static Job* exchange(Job* job);

  void has_read(const std::filesystem::path& file, std::string_view bytes);
  // Returns each file once, in the order in which they were read.
  std::vector<FileRead> files_read() const;

  // Makes end() call `settle` with the exit code, the last one registered first.
  void at_end(std::function<void(int exit_code)> settle);
  void end(int exit_code);

 private:
  static inline thread_local Job* current_ = nullptr;

  Job* const before_;
  mutable std::mutex mutex_;
  std::vector<FileRead> files_;
  std::unordered_set<std::string> known_;  // their names
  std::vector<std::function<void(int)>> settlements_;
};

// Lets a thread work for a job while this object lives.
class WorkingFor {
 public:
  explicit WorkingFor(Job* job) : own_(Job::exchange(job)) {}
  ~WorkingFor() { Job::exchange(own_); }
  WorkingFor(const WorkingFor&) = delete;
  WorkingFor& operator=(const WorkingFor&) = delete;

 private:
  Job* const own_;
};

}  // namespace hysteron
