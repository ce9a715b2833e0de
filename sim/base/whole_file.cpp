#include "sim/base/whole_file.h"

#include <fcntl.h>
#include <sys/stat.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>

#include "sim/base/job.h"

namespace hysteron {
namespace {

Error failure(const std::string& attempt, int code) {
  return Error::system(attempt + ": " + std::strerror(code ? code : EIO));
}

void check_kind(const struct stat& status, const std::string& attempt) {
  if (S_ISREG(status.st_mode)) return;
  throw Error::system(attempt + (S_ISDIR(status.st_mode)
                                     ? ": it is a folder"
                                     : ": it is a pipe or a device; write it to a file first"));
}

void check_size(std::size_t bytes, const std::string& attempt, std::size_t most) {
  if (bytes <= most) return;
  throw Error::invalid_input(attempt + ": it is larger than " + std::to_string(most >> 20) + " MiB");
}

}  // namespace

std::string whole_file(const std::filesystem::path& file, const std::string& attempt, std::size_t most) {
  struct stat status {};
  if (stat(file.c_str(), &status) != 0) throw failure(attempt, errno);
  check_kind(status, attempt);
  // O_NONBLOCK: a file that was replaced by a pipe after the check does not wait for a writer.
  const int number = open(file.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> stream(number < 0 ? nullptr : fdopen(number, "rb"),
                                                               &std::fclose);
  if (!stream || fstat(number, &status) != 0) throw failure(attempt, errno);
  check_kind(status, attempt);
  check_size(static_cast<std::size_t>(status.st_size), attempt, most);
  std::string bytes;
  bytes.reserve(static_cast<std::size_t>(status.st_size));
  char block[1 << 16];
  while (const std::size_t count = std::fread(block, 1, sizeof block, stream.get())) {
    bytes.append(block, count);
    check_size(bytes.size(), attempt, most);
  }
  if (std::ferror(stream.get())) throw failure(attempt, errno);
  if (Job* const job = Job::current()) job->has_read(file, bytes);
  return bytes;
}

std::string whole_file(const std::filesystem::path& file) {
  return whole_file(file, "cannot read " + file.string());
}

std::string file_named(const std::filesystem::path& file, const std::string& attempt) {
  try {
    return whole_file(file, attempt);
  } catch (const Error& error) {
    throw Error::invalid_input(error.what());
  }
}

void check_there(const std::filesystem::path& path) {
  if (!std::filesystem::exists(path)) throw Error::invalid_input("no such file or folder: " + path.string());
}

Error unreadable(const std::filesystem::path& folder, const std::error_code& reason) {
  return Error::system("cannot read the folder " + folder.string() + ": " + reason.message());
}

}  // namespace hysteron
