#include "sim/base/atomic_file.h"

#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>

#include "sim/base/error.h"

namespace hysteron {
namespace {
namespace fs = std::filesystem;

// Returns the file that is to be replaced: a link is followed and keeps its name.  Devices and pipes are
// never replaced, nor is what /dev/stdout leads to, even if that is a file.
std::string plain_file(const std::string& target) {
  constexpr int kMaxLinks = 40;  // the kernel follows no more
  std::error_code failure;
  bool plain = true;
  fs::path file = target;
  for (int links = 0; links < kMaxLinks && fs::is_symlink(fs::symlink_status(file, failure)); ++links) {
    plain = plain && !fs::weakly_canonical(file.parent_path(), failure).string().starts_with("/proc/");
    file = file.parent_path() / fs::read_symlink(file, failure);
  }
  const fs::file_status status = fs::symlink_status(file, failure);
  if (!plain || (fs::exists(status) && !fs::is_regular_file(status) && !fs::is_directory(status)))
    throw Error::invalid_input("cannot write " + target + ": it is no plain file; give another name");
  return file.string();
}

// The name is unique within the process (worker threads) and between processes; it lies in the same folder,
// so that the rename is atomic.
std::string temporary_name(const std::string& target) {
  static std::atomic<unsigned> count{0};
  return target + ".part-" + std::to_string(getpid()) + "-" + std::to_string(count++);
}

Error failure(const std::string& attempt, const std::string& file, int code) {
  const std::string reason = code ? std::strerror(code) : "the stream failed (disk full?)";
  return Error::system(attempt + " " + file + ": " + reason);
}

}  // namespace

AtomicFile::AtomicFile(const std::string& target)
    : target_(plain_file(target)), temporary_(temporary_name(target_)) {
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

namespace {

// Returns the first part of the path that is a link to nothing; empty if there is none.
fs::path dangling_link(const fs::path& path) {
  std::error_code ignored;
  fs::path part;
  for (const fs::path& name : path) {
    part /= name;
    if (fs::is_symlink(fs::symlink_status(part, ignored)) && !fs::exists(part, ignored)) return part;
  }
  return {};
}

}  // namespace

void make_folders(const fs::path& folder) {
  std::error_code failure, ignored;
  fs::create_directories(folder, failure);
  if (!failure && !fs::is_directory(folder, failure) && !failure)
    failure = std::make_error_code(std::errc::not_a_directory);
  if (!failure) return;
  const fs::path link = dangling_link(folder);
  throw Error::system("cannot create the folder " + folder.string() + ": " +
                      (link.empty()
                           ? failure.message()
                           : link.string() + " is a link to " + fs::read_symlink(link, ignored).string() +
                                 ", which does not exist"));
}

void write_text(const std::filesystem::path& file, const std::string& text) {
  AtomicFile target(file.string());
  target.stream() << text;
  target.commit();
}

}  // namespace hysteron
