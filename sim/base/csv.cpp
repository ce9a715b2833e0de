#include "sim/base/csv.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "sim/base/atomic_file.h"
#include "sim/base/comma_list.h"
#include "sim/base/number_in.h"
#include "sim/base/whole_file.h"

namespace hysteron {
namespace {

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view kBlank = " \t\r";
  const size_t first = text.find_first_not_of(kBlank);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlank) - first + 1);
}

// What separates the fields of a table with this head: a semicolon or a tab that stands there outside of
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

// "-0,35" is "-0.35"; what is no number stays.
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
  Rows(const std::string& text, const std::string& file) : text_(text), file_(file) {
    if (text.starts_with("\xEF\xBB\xBF")) at_ = 3;
    const std::size_t head = std::min(text.find_first_not_of(" \t\r\n", at_), text.size());
    separator_ = separator_in(std::string_view(text).substr(head, text.find('\n', head) - head));
  }

  // The next row that is not blank; false at the end.
  bool next(std::vector<std::string>& fields) {
    while (at_ < text_.size()) {
      line_ += lines_read_;
      lines_read_ = 0;
      fields = read();
      ++at_, ++lines_read_;
      if (fields.size() == 1 && trimmed(fields[0]).empty()) continue;
      if (separator_ != ',')
        for (std::string& field : fields) field = with_decimal_point(std::move(field));
      return true;
    }
    return false;
  }
  // Where the row begins that was read last.
  int line() const { return line_; }

 private:
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
      } else if (c != '\r') {
        fields.back() += c;
      }
    }
    return fields;
  }

  const std::string& text_;
  const std::string& file_;
  std::size_t at_ = 0;
  int line_ = 1, lines_read_ = 0;
  char separator_ = ',';
};

// Why a column is not the one that is wanted: another name would not change its numbers.
std::string other_unit(std::string_view column, const std::string& wanted) {
  const std::string name = quantity_in(column), unit = unit_in(column), must = unit_in(wanted);
  if (must.empty()) return fmt::format("column '{}' must be called '{}'", trimmed(column), wanted);
  if (unit.empty())
    return fmt::format("column '{}' names no unit; its numbers must be in {}, as '{}' says", name, must,
                       wanted);
  if (unit == must) return fmt::format("column '{}' must be written '{}'", trimmed(column), wanted);
  return fmt::format("column '{}' is in {} and must be in {}: convert its numbers, not its name", name, unit,
                     must);
}

// Refuses a column that stands twice or is there in another unit, or one of words.
void check_column(const Table& table, const std::string& wanted, bool needed) {
  bool found = false;
  for (const std::string& name : table.head) {
    if (quantity_in(name) != quantity_in(wanted)) continue;
    if (name != wanted) throw error_at(table.file, 1, other_unit(name, wanted));
    if (found) throw error_at(table.file, 1, "column '" + wanted + "' stands twice");
    found = true;
  }
  if (!found && needed)
    throw error_at(table.file, 1, "column '" + wanted + "' is missing; the header names it with its unit");
}

std::string quoted_where_needed(const std::string& text) {
  if (text.find_first_of(",\"\n") == text.npos) return text;
  std::string quoted = "\"";
  for (char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

std::string exact_field(double value) { return fmt::format("{:.17g}", value); }

}  // namespace

std::string quantity_in(std::string_view column) {
  return std::string(trimmed(column.substr(0, column.find('['))));
}

std::string unit_in(std::string_view column) {
  const std::size_t open = column.find('['), close = column.rfind(']');
  if (open == column.npos || close == column.npos || close < open) return "";
  return std::string(trimmed(column.substr(open + 1, close - open - 1)));
}

Table::Table(const std::string& names) : head(split(names)) {}

Table::Table(const std::vector<Column>& columns) {
  for (const Column& column : columns) head.push_back(column.name);
  rows.resize(columns.empty() ? 0 : columns[0].values.size());
  for (std::size_t r = 0; r < rows.size(); ++r)
    for (const Column& column : columns) rows[r].push_back(exact_field(column.values[r]));
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
  return vector_component(word(row, column)).value_or(NAN);
}

double Table::finite(std::size_t row, std::size_t column) const {
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

Table table_in(const std::string& text, const std::string& file) {
  Table table;
  table.file = file;
  Rows rows(text, file);
  for (std::vector<std::string> row; rows.next(row);) {
    if (table.head.empty()) {
      for (const std::string& name : row) table.head.emplace_back(trimmed(name));
      continue;
    }
    if (row.size() != table.head.size())
      throw error_at(file, rows.line(), fmt::format("{} fields, must be {}", row.size(), table.head.size()));
    table.rows.push_back(std::move(row));
    table.lines.push_back(rows.line());
  }
  return table;
}

Table read_table(const std::filesystem::path& csv) {
  return table_in(whole_file(csv, "cannot read " + csv.string()), csv.string());
}

Table read_csv(const std::filesystem::path& file, const std::vector<std::string>& required,
               const std::vector<std::string>& optional, const std::string& reader) {
  try {
    Table table = read_table(file);
    for (const std::string& name : required) check_column(table, name, true);
    for (const std::string& name : optional) check_column(table, name, false);
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

std::string number_field(double value) { return std::isfinite(value) ? fmt::format("{:.6g}", value) : ""; }

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
