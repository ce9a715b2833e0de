// The one table of words and numbers: named columns, with units in their names, `curvature [1/m],moment [N]`;
// written as CSV and read back (RFC 4180: a field that needs it stands in quotes).  Tables are also read
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

// Split a column's name: the quantity of "Curvature (1/m)" and "curvature [m^-1]" is "curvature", its unit
// "1/m" (plain_unit()), or "" without one.
std::string quantity_in(std::string_view column);
std::string unit_in(std::string_view column);

// Writes six significant digits, and nothing for a number that is not finite.
std::string number_field(double value);

// A field of a table, as it is written to the file.
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
  std::vector<int> lines{};                      // the line of each row in the file it was read from
  std::string file{}, reader{};  // the file that it was read from, and on whose behalf ("law")
  // The marks among "," and "." that may stand before decimals or between thousands: "1,000" is then not a
  // number.
  std::string implausible_marks{};

  Table() = default;
  // Takes the names of the columns: "fabric,law,step [s]".
  explicit Table(const std::string& names);
  explicit Table(std::vector<std::string> names) : head(std::move(names)) {}
  // Takes columns of one length and writes 17 significant digits, so that reading gives the same doubles.
  explicit Table(const std::vector<Column>& columns);

  void row(const std::vector<Cell>& cells);
  void write(const std::filesystem::path& csv) const;  // throws as AtomicFile does

  std::optional<std::size_t> find(const std::string& column) const;
  // Throws Error::invalid_input, naming the file, if there is no such column.
  std::size_t at(const std::string& column) const;
  const std::string& word(std::size_t row, const std::string& column) const { return rows[row][at(column)]; }
  double number(std::size_t row, const std::string& column) const;  // NaN if the cell is not a number
  // Returns the mark for which a field may be one number or another; 0 if the number is certain.
  char implausible_mark(std::string_view field) const;
  // Throws Error::invalid_input, with file and line, if the cell is not a finite number.
  double finite(std::size_t row, std::size_t column) const;
  // Returns the finite numbers of all rows; throws as finite() does.
  std::vector<double> numbers(std::size_t column) const;
  std::vector<double> numbers(const std::string& column) const { return numbers(at(column)); }

  // Returns each value of a column once, in the order in which they come.
  std::vector<std::string> values(const std::string& column) const;
  // Returns the rows whose cell in `column` is `value`, or the same number.
  Table where(const std::string& column, const std::string& value) const;
  // Returns those of these columns that the table has.
  Table only(const std::vector<std::string>& columns) const;

  // Returns an Error::invalid_input about a row that was read: "law: loop.csv:3: WHAT".
  Error refusal(std::size_t row, const std::string& what) const;
};

// Throws Error::system if the file cannot be read, Error::invalid_input (with file:line) if a row has another
// number of fields or a quote is not closed.
Table read_table(const std::filesystem::path& csv);
// Reads the same from the bytes of a file of that name.
Table table_in(const std::string& bytes, const std::string& file);
// Reads a table whose columns `required` and, where present, `optional` are numbers.  `reader` says on whose
// behalf ("law"), for errors.  Throws also Error::invalid_input if one of them is missing, named twice, in
// another unit or has a cell that is not a finite number, or if there are no rows.
Table read_csv(const std::filesystem::path& file, const std::vector<std::string>& required,
               const std::vector<std::string>& optional, const std::string& reader);

// Returns a line of a table, its end included.
std::string csv_row(const std::vector<std::string>& fields);
// Returns a line of numbers with 17 significant digits.
std::string exact_csv_row(const std::vector<double>& numbers);

// Sets cells beside each other for a terminal, each as wide as its width says, left-aligned if that is
// negative; further cells are as wide as the last.  Blanks at the end are left out.
std::string aligned(const std::vector<std::string>& cells, const std::vector<int>& widths);

}  // namespace hysteron
