// A folder of documentation: what programs write in its pages.
#pragma once

#include "experiments/report/page.h"

namespace hysteron::experiments {

// Whether a folder holds pages of Markdown beside its README.md.
bool is_documentation(const std::filesystem::path& folder);

// Its pages and the README.md beside the folder, by name, with tables of keys and exit codes (key_tables.h),
// tables of recorded files (table_blocks.h) and numbers (linked_numbers.h) as they should be.  Throws
// Error::system if a file cannot be read.
std::vector<Page> documentation(const std::filesystem::path& folder);

}  // namespace hysteron::experiments
