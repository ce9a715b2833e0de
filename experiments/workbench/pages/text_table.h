// Formats tables of words and numbers for a page.
#pragma once

#include <string>

#include "sim/base/csv.h"

namespace hysteron::experiments {

// Removes columns with the same value in every row and returns them, "device: cpu, precision: double"; empty
// ones are left out.  A table of one row stays whole.
std::string take_common(Table& table);

// Returns HTML with units apart from names, long numbers in six digits, and numbers right-aligned.
std::string text_table_html(const Table& table);

}  // namespace hysteron::experiments
