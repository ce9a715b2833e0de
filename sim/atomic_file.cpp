#include "sim/atomic_file.h"

#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstring>

#include "sim/error.h"

namespace hysteron {
namespace {

// Unique within the process (worker threads) and between processes; same folder, so that rename is atomic.
std::string temporary_name(const std::string& target) {
  static std::atomic<unsigned> count{0};
  return target + ".part-" + std::to_string(getpid()) + "-" + std::to_string(count++);
}

Error failure(const std::string& attempt, const std::string& file, int code) {
  const std::string reason = code ? std::strerror(code) : "the stream failed (disk full?)";
  return Error::machine(attempt + " " + file + ": " + reason);
}

}  // namespace

AtomicFile::AtomicFile(const std::string& target) : target_(target), temporary_(temporary_name(target)) {
  errno = 0;
  stream_.open(temporary_, std::ios::binary | std::ios::trunc);
  if (!stream_) throw failure("cannot create", target_, errno);
}

AtomicFile::~AtomicFile() {
  if (committed_) return;
  stream_.close();
  std::remove(temporary_.c_str());
}

void AtomicFile::commit() {
  errno = 0;
  const bool written = static_cast<bool>(stream_.flush());
  const int code = errno;
  stream_.close();
  if (!written || !stream_) throw failure("cannot write", target_, code);
  if (std::rename(temporary_.c_str(), target_.c_str()) != 0)
    throw failure("cannot rename to", target_, errno);
  committed_ = true;
}

}  // namespace hysteron
