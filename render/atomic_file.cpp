#include "render/atomic_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstring>
#include <string>

#include "sim/error.h"

namespace hysteron::render {
namespace {

bool write_all(int file, std::span<const std::uint8_t> bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(file, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return false;
    bytes = bytes.subspan(static_cast<size_t>(written));
  }
  return true;
}

Error write_error(const std::filesystem::path& path, int reason) {
  return Error::machine("writing " + path.string() + ": " + std::strerror(reason) +
                        "; check that the folder is writable and the disk has space");
}

}  // namespace

std::filesystem::path temporary_beside(const std::filesystem::path& path) {
  static std::atomic<unsigned> count{0};
  const std::string mark = ".part-" + std::to_string(::getpid()) + "-" + std::to_string(count++);
  // The extension stays last: programs that write the file may choose the format by it.
  return path.parent_path() / (path.stem().string() + mark + path.extension().string());
}

void rename_into_place(const std::filesystem::path& temporary, const std::filesystem::path& path) {
  if (std::rename(temporary.c_str(), path.c_str()) == 0) return;
  const int reason = errno;
  ::unlink(temporary.c_str());
  throw write_error(path, reason);
}

void write_atomically(const std::filesystem::path& path, std::span<const std::uint8_t> bytes) {
  const auto temporary = temporary_beside(path);
  const int file = ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  if (file < 0) throw write_error(path, errno);
  const bool written = write_all(file, bytes);
  int reason = errno;
  // A network file system may report a full disk only on close.
  const bool closed = ::close(file) == 0;
  if (written && closed) return rename_into_place(temporary, path);
  if (written) reason = errno;
  ::unlink(temporary.c_str());
  throw write_error(path, reason);
}

}  // namespace hysteron::render
