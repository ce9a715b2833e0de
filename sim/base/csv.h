// The one table of words and numbers: named columns, with units in their names, `curvature [1/m],moment [N]`;
// written as CSV and read back (RFC 4180: a field that needs it stands in quotes).  Read are also tables
// whose head is separated by semicolons or tabs, with decimal points or commas, in every encoding that
// plain_text() knows.  Blank lines and comments, which begin with #, are passed over; a comment above rows of
// numbers is their head.
#pragma once

#include <concepts>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sim/base/error.h"

namespace hysteron {

// The quantity of "Curvature (1/m)" and "curvature [m^-1]" is "curvature", its unit "1/m" (plain_unit()); ""
// without one.
std::string quantity_in(std::string_view column);
std::string unit_in(std::string_view column);

// Six significant digits, empty unless the number is finite.
std::string number_field(double value);

// A field of a table, as it is written.
struct Cell {
  std::string text;

  Cell(std::string word) : text(std::move(word)) {}
  Cell(const char* word) : text(word) {}
  Cell(double value) : text(number_field(value)) {}
  template <std::integral Integer>
  Cell(Integer value) : text(std::to_string(value)) {}
};

// A column of numbers, with its unit in its name: "curvature [1/m]".
struct Column {
  std::string name;
  std::vector<double> values;
};

struct Table {
  std::vector<std::string> head{};
  std::vector<std::vector<std::string>> rows{};  // each as long as the head
  std::vector<int> lines{};                      // where each row stands in the file it was read from
  std::string file{}, reader{};                  // that it was read from, and on whose behalf ("law")
  // Of "," and ".", those that stand before decimals or between thousands: "1,000" is then no number.
  std::string doubtful_marks{};

  Table() = default;
  // "fabric,law,step [s]"
  explicit Table(const std::string& names);
  explicit Table(std::vector<std::string> names) : head(std::move(names)) {}
  // Columns of one length, with 17 significant digits, so that reading gives the same doubles.
  explicit Table(const std::vector<Column>& columns);

  void row(const std::vector<Cell>& cells);
  void write(const std::filesystem::path& csv) const;  // throws as AtomicFile does

  std::optional<std::size_t> find(const std::string& column) const;
  // Error::invalid_input, naming the file, if there is no such column.
  std::size_t at(const std::string& column) const;
  const std::string& word(std::size_t row, const std::string& column) const { return rows[row][at(column)]; }
  double number(std::size_t row, const std::string& column) const;  // NaN of a cell that is none
  // The mark for which a field may be one number or another; 0 if it is certain.
  char doubtful_mark(std::string_view field) const;
  // Error::invalid_input, with file and line, of a cell that is no finite number.
  double finite(std::size_t row, std::size_t column) const;
  // The same, of all rows.
  std::vector<double> numbers(std::size_t column) const;
  std::vector<double> numbers(const std::string& column) const { return numbers(at(column)); }

  // Each value of a column once, in the order in which they come.
  std::vector<std::string> values(const std::string& column) const;
  // The rows whose cell in `column` is `value`, or the same number.
  Table where(const std::string& column, const std::string& value) const;
  // These columns, of those that there are.
  Table only(const std::vector<std::string>& columns) const;

  // Error::invalid_input of a row that was read: "law: loop.csv:3: WHAT".
  Error refusal(std::size_t row, const std::string& what) const;
};

// Throws Error::system if the file cannot be read, Error::invalid_input (with file:line) if a row has another
// number of fields or a quote is not closed.
Table read_table(const std::filesystem::path& csv);
// The same of the bytes of a file of that name.
Table table_in(const std::string& bytes, const std::string& file);
// A table of which the columns `required` and, where present, `optional` are numbers.  `reader` says on whose
// behalf ("law"), for errors.  Throws also Error::invalid_input if one of them is missing, named twice, in
// another unit or has a cell that is no finite number, or if there are no rows.
Table read_csv(const std::filesystem::path& file, const std::vector<std::string>& required,
               const std::vector<std::string>& optional, const std::string& reader);

// A line of a table, its end included.
std::string csv_row(const std::vector<std::string>& fields);
// Of numbers with 17 significant digits.
std::string exact_csv_row(const std::vector<double>& numbers);

// Cells beside each other on a terminal, each in its width, to the left of a negative one; further ones are
// as wide as the last.  Blanks at the end are left out.
std::string aligned(const std::vector<std::string>& cells, const std::vector<int>& widths);

}  // namespace hysteron
