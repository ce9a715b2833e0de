// Reads tables as testers' programs write them: lines before the head, semicolons or tabs between columns,
// decimal commas where the comma does not separate columns.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "sim/base/csv.h"

namespace hysteron {

// Reads the lines from the first one on with a field that `is_of_head` accepts.  Throws Error::system, and
// Error::invalid_input if there is no such line (`wanted` names it: "a column curvature") or no row behind
// it.
Table read_tester_table(const std::filesystem::path& file,
                        const std::function<bool(const std::string& field)>& is_of_head,
                        const std::string& wanted, const std::string& reader);

}  // namespace hysteron
