// Tables of words and numbers, to be shown.
#pragma once

#include <string>

#include "sim/base/csv.h"

namespace hysteron::experiments {

// Takes columns out that say the same in every row, "device: cpu, precision: double"; empty ones are left
// out.  A table of one row stays whole.
std::string take_common(Table& table);

// HTML: names with their units apart, long numbers with six digits, numbers to the right.
std::string text_table_html(const Table& table);

}  // namespace hysteron::experiments
