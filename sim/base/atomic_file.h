// A file that appears under its name only when it is complete.
#pragma once

#include <filesystem>
#include <fstream>
#include <string>

namespace hysteron {

// Writes beside the target under a temporary name and renames on commit(), so that a reader (or a full disk,
// or a killed run) never leaves half a file under the final name.  Without commit() the temporary file is
// removed on destruction.  If the target is a link, the file that it leads to is replaced.
class AtomicFile {
 public:
  // Opens the temporary file (binary).  Throws Error::system with the file's name and the system's reason,
  // Error::invalid_input for a device or a pipe.
  explicit AtomicFile(const std::string& target);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  std::ostream& stream() { return stream_; }
  // This name serves writers that open a file themselves (plot programs, image libraries).
  const std::string& temporary() const { return temporary_; }
  // Flushes, closes, checks and renames.  Throws Error::system; the target is then as it was before.
  void commit();

 private:
  std::string target_;
  std::string temporary_;
  std::ofstream stream_;
  bool committed_ = false;
};

// Makes the folder and its parents.  Throws Error::system, which says so where a link on the way leads to
// nothing.
void make_folders(const std::filesystem::path& folder);

// Writes a whole file at once.
void write_text(const std::filesystem::path& file, const std::string& text);

}  // namespace hysteron
