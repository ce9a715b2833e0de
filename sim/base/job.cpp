#include "sim/base/job.h"

#include <utility>

#include "sim/base/fnv1a.h"

namespace hysteron {

Job::Job() : before_(exchange(this)) {}

Job::~Job() { exchange(before_); }

Job* Job::exchange(Job* job) { return std::exchange(current_, job); }

void Job::has_read(const std::filesystem::path& file, std::string_view bytes) {
  const std::uint64_t hash = fnv1a(bytes.data(), bytes.size());
  const std::lock_guard lock(mutex_);
  if (known_.insert(file.string()).second) files_.push_back({file, hash});
}

std::vector<FileRead> Job::files_read() const {
  const std::lock_guard lock(mutex_);
  return files_;
}

void Job::at_end(std::function<void(int)> settle) {
  const std::lock_guard lock(mutex_);
  settlements_.push_back(std::move(settle));
}

void Job::end(int exit_code) {
  std::vector<std::function<void(int)>> settlements;
  {
    const std::lock_guard lock(mutex_);
    settlements.swap(settlements_);
  }
  for (auto settle = settlements.rbegin(); settle != settlements.rend(); ++settle) (*settle)(exit_code);
}

}  // namespace hysteron
