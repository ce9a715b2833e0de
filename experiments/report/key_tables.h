// The keys of scenes and the exit codes as tables in Markdown, written between two comments of a page of
// documentation.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace hysteron::experiments {

// A table for each kind of key (scene, [[pin]], [[obstacle]], keyframe, [[command]], [[phase]]), from the
// tables that reading, flags, --help and checks come from.
std::string key_tables();

// A line for each exit code.
std::string exit_code_table();

// A Markdown file with `<!-- keys:begin -->` and `<!-- keys:end -->`, which key_tables() stands between, or
// with the same of `exit-codes` and exit_code_table().
struct KeyPage {
  std::filesystem::path file;
  std::string text;  // as it should be
  bool stale = false;
};

// Those of a folder, by name; other Markdown files have none of the comments.  Throws Error::request if the
// one that ends is missing, Error::machine if a file cannot be read.
std::vector<KeyPage> key_pages(const std::filesystem::path& folder);

}  // namespace hysteron::experiments
