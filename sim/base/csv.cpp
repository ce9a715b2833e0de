#include "sim/base/csv.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <string_view>
#include <utility>

#include "sim/base/atomic_file.h"
#include "sim/base/comma_list.h"
#include "sim/base/number_in.h"
#include "sim/base/plain_text.h"
#include "sim/base/whole_file.h"

namespace hysteron {
namespace {

constexpr int kExact = 17;  // digits of which reading makes the same double

// Returns the separator of the fields below this head: a semicolon or a tab that stands there outside of
// quotes, else the comma.
char separator_in(std::string_view head) {
  bool quoted = false, tab = false;
  for (const char c : head) {
    if (c == '"') quoted = !quoted;
    if (quoted) continue;
    if (c == ';') return ';';
    tab = tab || c == '\t';
  }
  return tab ? '\t' : ',';
}

std::string_view without_plus(std::string_view field) {
  field = trimmed(field);
  if (!field.empty() && field.front() == '+') field.remove_prefix(1);
  return field;
}

std::optional<double> vector_component(std::string_view field) { return number_in(without_plus(field)); }

// Turns "-0,35" into "-0.35"; a text that is not a number stays.
std::string with_decimal_point(std::string field) {
  const std::size_t comma = field.find(',');
  if (comma == field.npos) return field;
  std::string number = field;
  number[comma] = '.';
  return vector_component(number) ? number : field;
}

Error error_at(const std::string& file, int line, const std::string& what) {
  return Error::invalid_input(fmt::format("{}:{}: {}", file, line, what));
}

// Walks through the text of a file, row by row.
class Rows {
 public:
  Rows(const std::string& text, const std::string& file) : text_(text), file_(file) { find_head(); }

  char separator() const { return separator_; }
  // The names in a comment above the first row, where that row has numbers alone; empty: the first row is the
  // head.
  const std::vector<std::string>& head_in_comment() const { return head_; }

  // Reads the next row that is neither blank nor a comment; false at the end.
  bool next(std::vector<std::string>& fields) {
    while (at_ < text_.size()) {
      line_ += lines_read_;
      lines_read_ = 0;
      const bool comment = is_comment(line_at(at_));
      if (comment)
        at_ = std::min(text_.find('\n', at_), text_.size());
      else
        fields = read();
      ++at_, ++lines_read_;
      if (comment || (fields.size() == 1 && trimmed(fields[0]).empty())) continue;
      return true;
    }
    return false;
  }
  // Returns the line at which the row that was read last begins.
  int line() const { return line_; }

 private:
  static bool is_comment(std::string_view line) { return trimmed(line).starts_with('#'); }

  std::string_view line_at(std::size_t at) const {
    return std::string_view(text_).substr(at, std::min(text_.find('\n', at), text_.size()) - at);
  }

  std::vector<std::string> fields_of(std::string_view line, char separator) const {
    std::vector<std::string> fields(1);
    for (const char c : line) {
      if (c == separator)
        fields.emplace_back();
      else
        fields.back() += c;
    }
    return fields;
  }

  // Finds the separator in the first line that is neither blank nor a comment, or in the comment above it if
  // that names the columns of a line of numbers, as numpy.savetxt writes it.
  void find_head() {
    std::string_view comment, first;
    for (std::size_t at = 0; at < text_.size() && first.empty(); at += line_at(at).size() + 1) {
      const std::string_view line = trimmed(line_at(at));
      if (is_comment(line))
        comment = line;
      else
        first = line;
    }
    separator_ = separator_in(first);
    comment.remove_prefix(std::min(comment.find_first_not_of('#'), comment.size()));
    const char separator = separator_in(comment);
    const std::vector<std::string> names = fields_of(comment, separator),
                                   numbers = fields_of(first, separator);
    if (trimmed(comment).empty() || names.size() != numbers.size()) return;
    for (const std::string& field : numbers)
      if (!vector_component(separator == ',' ? field : with_decimal_point(field))) return;
    separator_ = separator;
    head_ = names;
  }

  std::string quoted() {
    std::string field;
    const int start = line_ + lines_read_;
    for (++at_; at_ < text_.size(); ++at_) {
      if (text_[at_] == '"' && (++at_ >= text_.size() || text_[at_] != '"')) return field;
      lines_read_ += text_[at_] == '\n';
      field += text_[at_];
    }
    throw error_at(file_, start, "a quote is not closed");
  }

  std::vector<std::string> read() {
    std::vector<std::string> fields(1);
    while (at_ < text_.size() && text_[at_] != '\n') {
      if (text_[at_] == '"') {
        fields.back() += quoted();
      } else if (const char c = text_[at_++]; c == separator_) {
        fields.emplace_back();
      } else {
        fields.back() += c;
      }
    }
    return fields;
  }

  const std::string& text_;
  const std::string& file_;
  std::vector<std::string> head_;
  std::size_t at_ = 0;
  int line_ = 1, lines_read_ = 0;
  char separator_ = ',';
};

// Is true for up to three digits, this mark, and three digits: "1,000" and "-12.500", but not "0,125" and
// "1,5".
bool may_be_thousands(std::string_view field, char mark) {
  field = without_plus(field);
  if (field.starts_with('-')) field.remove_prefix(1);
  const std::size_t at = field.find(mark);
  if (at == field.npos || at == 0 || at > 3 || field.size() - at != 4 || field.front() == '0') return false;
  std::string digits(field);
  digits.erase(at, 1);
  return digits.find_first_not_of("0123456789") == digits.npos;
}

// Is the field a number with this mark before its decimals that cannot be one with thousands?
bool shows_decimals(const std::string& field, char mark) {
  if (field.find(mark) == field.npos || may_be_thousands(field, mark)) return false;
  return field.find(mark == ',' ? '.' : ',') == field.npos && vector_component(with_decimal_point(field));
}

// Returns the marks that may stand before decimals or between thousands in this table, whose columns no comma
// separates.  Other numbers of the table can show that a comma stands before decimals; points do unless
// commas do.
std::string implausible_marks(const Table& table) {
  bool comma = false, point = false;
  for (const std::vector<std::string>& row : table.rows)
    for (const std::string& field : row) {
      comma = comma || shows_decimals(field, ',');
      point = point || shows_decimals(field, '.');
    }
  return std::string(comma && !point ? "" : ",") + (comma ? "." : "");
}

// Turns decimal commas into points where they are certain.  "1,125" becomes "1.1250", which cannot have
// thousands.
void read_decimal_commas(Table& table) {
  table.implausible_marks = implausible_marks(table);
  const bool certain = table.implausible_marks.find(',') == table.implausible_marks.npos;
  for (std::vector<std::string>& row : table.rows)
    for (std::string& field : row) {
      const bool open = may_be_thousands(field, ',');
      if (open && !certain) continue;
      field = with_decimal_point(std::string(trimmed(field)) + (open ? "0" : ""));
    }
}

// Says why a field that may have thousands is not read.
std::string thousands_message(const std::string& column, std::string_view field, char mark) {
  std::string whole(field);
  std::replace(whole.begin(), whole.end(), mark, ' ');
  whole.erase(whole.find(' '), 1);
  std::string decimal(field);
  return fmt::format(
      "{} = '{}' may have {} decimals or thousands: write {}, or {}0 if these are decimals, and one "
      "mark before all decimals of the table",
      column, field, mark == ',' ? "a comma before" : "a point before", whole, decimal);
}

// Says why a column is not the wanted one; another name would not change its numbers.
std::string other_unit(std::string_view column, const std::string& wanted) {
  const std::string name = quantity_in(column), unit = unit_in(column), must = unit_in(wanted);
  if (must.empty()) return fmt::format("column '{}' must be called '{}'", trimmed(column), wanted);
  if (unit.empty())
    return fmt::format("column '{}' names no unit; its numbers must be in {}, as '{}' says", name, must,
                       wanted);
  return fmt::format("column '{}' is in {} and must be in {}: convert its numbers, not its name", name, unit,
                     must);
}

// Gives the column its wanted name; refuses a column that stands twice, is in another unit or holds words.
void name_column(Table& table, const std::string& wanted, bool needed) {
  bool found = false;
  for (std::string& name : table.head) {
    if (quantity_in(name) != quantity_in(wanted)) continue;
    if (unit_in(name) != unit_in(wanted)) throw error_at(table.file, 1, other_unit(name, wanted));
    if (found) throw error_at(table.file, 1, "column '" + wanted + "' stands twice");
    found = true;
    name = wanted;
  }
  if (!found && needed)
    throw error_at(table.file, 1, "column '" + wanted + "' is missing; the header names it with its unit");
}

std::string quoted_where_needed(const std::string& text) {
  if (text.find_first_of(",\"\n") == text.npos && !text.starts_with('#')) return text;
  std::string quoted = "\"";
  for (char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

}  // namespace

namespace {

// Returns the positions of the brackets around a column's unit, "[1/m]" or "(1/m)" at its end.
std::pair<std::size_t, std::size_t> unit_place(std::string_view column) {
  const std::size_t open = column.find('['), close = column.rfind(']');
  if (open != column.npos && close != column.npos && close > open) return {open, close};
  const std::size_t round = column.rfind('(');
  if (round != column.npos && trimmed(column).ends_with(')')) return {round, column.rfind(')')};
  return {std::min(open, column.size()), column.npos};
}

// Is true for units of time: testers write "t [s]" for time, while "t [mm]" is a thickness.
bool may_be_of_time(const std::string& unit) {
  constexpr const char* kUnits[] = {"", "s", "sec", "ms", "us", "min", "h"};
  return std::find(std::begin(kUnits), std::end(kUnits), unit) != std::end(kUnits);
}

}  // namespace

std::string quantity_in(std::string_view column) {
  std::string quantity;
  for (const char c : trimmed(column.substr(0, unit_place(column).first)))
    if (c != ' ' || quantity.back() != ' ')
      quantity += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return quantity == "t" && may_be_of_time(unit_in(column)) ? "time" : quantity;
}

std::string unit_in(std::string_view column) {
  const auto [open, close] = unit_place(column);
  return close == column.npos ? "" : plain_unit(column.substr(open + 1, close - open - 1));
}

Table::Table(const std::string& names) : head(split(names)) {}

Table::Table(const std::vector<Column>& columns) {
  for (const Column& column : columns) head.push_back(column.name);
  rows.resize(columns.empty() ? 0 : columns[0].values.size());
  for (std::size_t r = 0; r < rows.size(); ++r)
    for (const Column& column : columns) rows[r].push_back(number_text(column.values[r], kExact));
}

void Table::row(const std::vector<Cell>& cells) {
  std::vector<std::string>& fields = rows.emplace_back();
  for (const Cell& cell : cells) fields.push_back(cell.text);
}

void Table::write(const std::filesystem::path& csv) const {
  AtomicFile target(csv.string());
  target.stream() << csv_row(head);
  for (const std::vector<std::string>& fields : rows) target.stream() << csv_row(fields);
  target.commit();
}

std::optional<std::size_t> Table::find(const std::string& column) const {
  const auto found = std::find(head.begin(), head.end(), column);
  if (found == head.end()) return std::nullopt;
  return static_cast<std::size_t>(found - head.begin());
}

std::size_t Table::at(const std::string& column) const {
  if (const auto found = find(column)) return *found;
  const Error error = Error::invalid_input(file + " has no column " + column);
  throw reader.empty() ? error : error.with_experiment(reader);
}

double Table::number(std::size_t row, const std::string& column) const {
  const std::string& field = word(row, column);
  return implausible_mark(field) ? NAN : vector_component(field).value_or(NAN);
}

char Table::implausible_mark(std::string_view field) const {
  for (const char mark : implausible_marks)
    if (may_be_thousands(field, mark)) return mark;
  return 0;
}

double Table::finite(std::size_t row, std::size_t column) const {
  if (const char mark = implausible_mark(rows[row][column]))
    throw refusal(row, thousands_message(head[column], trimmed(rows[row][column]), mark));
  const std::optional<double> value = vector_component(rows[row][column]);
  if (!value || !std::isfinite(*value))
    throw refusal(
        row, fmt::format("{} = '{}' must be a finite number", head[column], without_plus(rows[row][column])));
  return *value;
}

std::vector<double> Table::numbers(std::size_t column) const {
  std::vector<double> values;
  for (std::size_t r = 0; r < rows.size(); ++r) values.push_back(finite(r, column));
  return values;
}

std::vector<std::string> Table::values(const std::string& column) const {
  const std::size_t place = at(column);
  std::vector<std::string> found;
  for (const auto& fields : rows)
    if (std::find(found.begin(), found.end(), fields[place]) == found.end()) found.push_back(fields[place]);
  return found;
}

Table Table::where(const std::string& column, const std::string& value) const {
  const std::size_t place = at(column);
  const std::optional<double> number = vector_component(value);
  Table some = *this;
  some.rows.clear(), some.lines.clear();
  for (std::size_t r = 0; r < rows.size(); ++r) {
    if (rows[r][place] != value && !(number && vector_component(rows[r][place]) == number)) continue;
    some.rows.push_back(rows[r]);
    if (!lines.empty()) some.lines.push_back(lines[r]);
  }
  return some;
}

Table Table::only(const std::vector<std::string>& columns) const {
  Table part = *this;
  part.head.clear();
  for (std::vector<std::string>& fields : part.rows) fields.clear();
  for (const std::string& column : columns) {
    const auto place = find(column);
    if (!place) continue;
    part.head.push_back(column);
    for (std::size_t r = 0; r < rows.size(); ++r) part.rows[r].push_back(rows[r][*place]);
  }
  return part;
}

Error Table::refusal(std::size_t row, const std::string& what) const {
  const Error error = error_at(file, lines.at(row), what);
  return reader.empty() ? error : error.with_experiment(reader);
}

Table table_in(const std::string& bytes, const std::string& file) {
  const std::string text = plain_text(bytes);
  Table table;
  table.file = file;
  Rows rows(text, file);
  const auto take_head = [&](const std::vector<std::string>& names) {
    for (const std::string& name : names) table.head.emplace_back(trimmed(name));
  };
  take_head(rows.head_in_comment());
  for (std::vector<std::string> row; rows.next(row);) {
    if (table.head.empty()) {
      take_head(row);
      continue;
    }
    if (row.size() != table.head.size())
      throw error_at(file, rows.line(), fmt::format("{} fields, must be {}", row.size(), table.head.size()));
    table.rows.push_back(std::move(row));
    table.lines.push_back(rows.line());
  }
  if (rows.separator() != ',') read_decimal_commas(table);
  return table;
}

Table read_table(const std::filesystem::path& csv) { return table_in(whole_file(csv), csv.string()); }

Table read_csv(const std::filesystem::path& file, const std::vector<std::string>& required,
               const std::vector<std::string>& optional, const std::string& reader) {
  try {
    Table table = read_table(file);
    for (const std::string& name : required) name_column(table, name, true);
    for (const std::string& name : optional) name_column(table, name, false);
    if (table.rows.empty()) throw error_at(table.file, 1, "no rows, at least one is needed");
    for (const auto* names : {&required, &optional})
      for (const std::string& name : *names)
        if (const auto place = table.find(name)) table.numbers(*place);
    table.reader = reader;
    return table;
  } catch (const Error& error) {
    throw error.with_experiment(reader);
  }
}

std::string number_field(double value) { return std::isfinite(value) ? number_text(value, 6) : ""; }

std::string csv_row(const std::vector<std::string>& fields) {
  std::string row;
  for (std::size_t i = 0; i < fields.size(); ++i) row += (i ? "," : "") + quoted_where_needed(fields[i]);
  return row + "\n";
}

std::string exact_csv_row(const std::vector<double>& numbers) {
  return fmt::format("{:.17g}\n", fmt::join(numbers, ","));
}

std::string aligned(const std::vector<std::string>& cells, const std::vector<int>& widths) {
  std::string line;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const int width = i < widths.size() ? widths[i] : widths.back();
    line += (i ? " " : "") +
            (width < 0 ? fmt::format("{:<{}}", cells[i], -width) : fmt::format("{:>{}}", cells[i], width));
  }
  return line.substr(0, line.find_last_not_of(' ') + 1);
}

}  // namespace hysteron
