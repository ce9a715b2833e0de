// Pages of documentation in Markdown: what programs write in them, and what is wrong there.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace hysteron::experiments {

// What is not as it should be, at a line of the page as it stands.
struct Fault {
  int line = 0;
  std::string what;     // "\"127.9°\" must be \"127.8°\""
  bool mended = false;  // in the page's text
};

struct Page {
  std::filesystem::path file;
  std::string text;  // first as it stands, then as it should be
  std::vector<Fault> faults;
};

// 1 for the first.
int line_at(const std::string& text, std::size_t place);

// The text with everything in fenced blocks, code spans and comments replaced by blanks, byte by byte.
std::string without_code(const std::string& text);

// Whether a folder holds pages of Markdown beside its README.md.
bool is_documentation(const std::filesystem::path& folder);

// Its pages and the README.md beside the folder, by name, with tables of keys and exit codes (key_tables.h),
// tables of recorded files (table_blocks.h) and numbers (linked_numbers.h) as they should be.  Throws
// Error::system if a file cannot be read.
std::vector<Page> documentation(const std::filesystem::path& folder);

}  // namespace hysteron::experiments
