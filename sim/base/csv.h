// Comma-separated tables with named columns and units in the header: `curvature [1/m],moment [N]`.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace hysteron {

struct Column {
  std::string name;            // as in the header, with its unit: "curvature [1/m]", "edit"
  std::vector<double> values;  // one per row
};

struct Table {
  std::vector<Column> columns;  // all of one length
  std::vector<int> lines;       // where each row stands in the file it was read from; empty otherwise
  // The column called `name`, null if there is none.
  const Column* find(const std::string& name) const;
};

// Reads the columns `required` and, where present, `optional`; others are ignored.  Blank lines are skipped,
// a byte order mark and carriage returns are tolerated.  `reader` says on whose behalf ("law"), for errors.
// Throws Error::machine if the file cannot be read; Error::request (with file:line) if a column is missing,
// named twice or in another unit, if a row has another number of fields, if a field is no finite number, or
// if there are no rows.
Table read_csv(const std::filesystem::path& file, const std::vector<std::string>& required,
               const std::vector<std::string>& optional, const std::string& reader);

// Writes with 17 significant digits, so that reading gives the same doubles, under a temporary name that
// becomes `file` once it is complete.  Throws Error::machine and leaves nothing if that fails.
void write_csv(const std::filesystem::path& file, const Table& table);

// A line of a table of words and numbers, its end included; fields are quoted where they need it.
std::string row_of(const std::vector<std::string>& fields);
// A field of it: six significant digits, empty unless the number is finite.
std::string number_field(double value);

}  // namespace hysteron
