// Comma-separated tables: of numbers, with named columns and units in the header, `curvature [1/m],moment
// [N]`, and of words and numbers.  The one reader and the one writer of them (RFC 4180: a field that needs it
// stands in quotes).  Read are also tables whose header is separated by semicolons or tabs, with decimal
// points or commas; a byte order mark, carriage returns and blank lines are tolerated.
#pragma once

#include <concepts>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "sim/base/atomic_file.h"
#include "sim/base/error.h"

namespace hysteron {

struct Column {
  std::string name;            // as in the header, with its unit: "curvature [1/m]", "edit"
  std::vector<double> values;  // one per row
};

// Of "curvature [1/m]" the quantity is "curvature" and the unit "1/m"; "" without one.
std::string quantity_in(std::string_view column);
std::string unit_in(std::string_view column);

struct Table {
  std::vector<Column> columns;   // all of one length
  std::vector<int> lines;        // where each row stands in the file it was read from; empty otherwise
  std::string file{}, reader{};  // that it was read from, and on whose behalf ("law")
  // The column called `name`, null if there is none.
  const Column* find(const std::string& name) const;
  // Error::invalid_input of a row that was read: "law: loop.csv:3: WHAT".
  Error refusal(std::size_t row, const std::string& what) const;
};

// Reads the columns `required` and, where present, `optional`; others are ignored.  `reader` says on whose
// behalf ("law"), for errors.  Throws Error::system if the file cannot be read; Error::invalid_input (with
// file:line) if a column is missing, named twice or in another unit, if a row has another number of fields,
// if a field is no finite number, or if there are no rows.
Table read_csv(const std::filesystem::path& file, const std::vector<std::string>& required,
               const std::vector<std::string>& optional, const std::string& reader);
// All columns; a table without columns if there are no rows.
Table read_whole_csv(const std::filesystem::path& file, const std::string& reader);

struct TextTable {
  std::vector<std::string> head;
  std::vector<std::vector<std::string>> rows;  // each as long as the head
  std::vector<int> lines{};                    // where each row stands in its file
};

// Throws Error::system if the file cannot be read, Error::invalid_input (with file:line) if a row has another
// number of fields or a quote is not closed.
TextTable read_words(const std::filesystem::path& file);
// The same of the text of a file of that name.
TextTable words_in(const std::string& text, const std::string& file);

// Writes with 17 significant digits, so that reading gives the same doubles, under a temporary name that
// becomes `file` once it is complete.  Throws Error::system and leaves nothing if that fails.
void write_csv(const std::filesystem::path& file, const Table& table);

// Six significant digits, empty unless the number is finite.
std::string number_field(double value);

// A field of a table of words and numbers.
struct CsvField {
  std::string text;

  CsvField(std::string word) : text(std::move(word)) {}
  CsvField(const char* word) : text(word) {}
  CsvField(double value) : text(number_field(value)) {}
  template <std::integral Integer>
  CsvField(Integer value) : text(std::to_string(value)) {}
};

// A line of a table, its end included.
std::string row_of(const std::vector<CsvField>& fields);
// Of numbers with 17 significant digits.
std::string exact_row_of(const std::vector<double>& numbers);

// A table of words and numbers that gets its name once it is complete.  Throws as AtomicFile does.
class CsvFile {
 public:
  // `head`: the first line, "fabric,law,step [s]".
  CsvFile(const std::filesystem::path& file, const std::string& head);
  CsvFile(const std::filesystem::path& file, const std::vector<CsvField>& head);

  void row(const std::vector<CsvField>& fields) { file_.stream() << row_of(fields); }
  void commit() { file_.commit(); }

 private:
  AtomicFile file_;
};

}  // namespace hysteron
