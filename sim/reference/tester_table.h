// Tables as testers' programs write them: lines before the head, semicolons or tabs between columns, decimal
// commas where the comma does not stand between columns.
#pragma once

#include <filesystem>
#include <string>

#include "sim/base/csv.h"

namespace hysteron {

// The lines from the first on that names `first_column` (a whole field, upper and lower case alike), its
// numbers with decimal points.  Throws Error::machine, and Error::request if there is no such line.
TextTable read_tester_table(const std::filesystem::path& file, const std::string& first_column,
                            const std::string& reader);

// The number in a field of a table; Error::request with file and line if there is none.
double number_of(const TextTable& table, std::size_t row, std::size_t column,
                 const std::filesystem::path& file, const std::string& reader);

}  // namespace hysteron
