// Tables as testers' programs write them: lines before the head, semicolons or tabs between columns, decimal
// commas where the comma does not stand between columns.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "sim/base/csv.h"

namespace hysteron {

// The lines from the first on with a field that `is_of_head` takes.  Throws Error::system, and
// Error::invalid_input if there is no such line (`wanted` says what it would have been: "a column curvature")
// or no row behind it.
Table read_tester_table(const std::filesystem::path& file,
                        const std::function<bool(const std::string& field)>& is_of_head,
                        const std::string& wanted, const std::string& reader);

}  // namespace hysteron
