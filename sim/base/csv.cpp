#include "sim/base/csv.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <string_view>

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

// "-0,35" is "-0.35"; what is no number stays.
std::string with_decimal_point(std::string field) {
  const std::size_t comma = field.find(',');
  if (comma == field.npos) return field;
  std::string number = field;
  number[comma] = '.';
  std::string_view digits = trimmed(number);
  if (!digits.empty() && digits.front() == '+') digits.remove_prefix(1);
  return number_in(digits) ? number : field;
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

double number(std::string_view text, const Table& table, const std::string& column) {
  std::string_view digits = trimmed(text);
  if (!digits.empty() && digits.front() == '+') digits.remove_prefix(1);
  const std::optional<double> value = number_in(digits);
  if (!value || !std::isfinite(*value))
    throw table.refusal(table.lines.size() - 1,
                        fmt::format("{} = '{}' must be a finite number", column, digits));
  return *value;
}

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

// Index of `wanted` in the header, or -1.  A column of that name in another unit is an error, not an absence.
int position(const std::vector<std::string>& header, const std::string& wanted, const std::string& file) {
  int found = -1;
  for (size_t i = 0; i < header.size(); ++i) {
    if (quantity_in(header[i]) != quantity_in(wanted)) continue;
    if (trimmed(header[i]) != wanted) throw error_at(file, 1, other_unit(header[i], wanted));
    if (found >= 0) throw error_at(file, 1, "column '" + wanted + "' stands twice");
    found = int(i);
  }
  return found;
}

// Where the columns stand in the words of a file.
std::vector<int> places_of(const std::vector<std::string>& required, const std::vector<std::string>& optional,
                           const TextTable& words, Table& table) {
  std::vector<int> places;
  const auto take = [&](const std::string& name, bool needed) {
    const int at = position(words.head, name, table.file);
    if (at < 0 && needed)
      throw error_at(table.file, 1, "column '" + name + "' is missing; the header names it with its unit");
    if (at < 0) return;
    table.columns.push_back({name, {}});
    places.push_back(at);
  };
  for (const std::string& name : required) take(name, true);
  for (const std::string& name : optional) take(name, false);
  return places;
}

void take_numbers(const TextTable& words, const std::vector<int>& places, Table& table) {
  for (std::size_t r = 0; r < words.rows.size(); ++r) {
    table.lines.push_back(words.lines[r]);
    for (size_t i = 0; i < places.size(); ++i)
      table.columns[i].values.push_back(
          number(words.rows[r][size_t(places[i])], table, table.columns[i].name));
  }
}

// Errors are the reader's.
template <class Read>
auto on_behalf_of(const std::string& reader, const Read& read) {
  try {
    return read();
  } catch (const Error& error) {
    throw error.experiment().empty() ? error.in(reader) : error;
  }
}

std::string quoted_where_needed(const std::string& text) {
  if (text.find_first_of(",\"\n") == text.npos) return text;
  std::string quoted = "\"";
  for (char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

}  // namespace

std::string quantity_in(std::string_view column) {
  return std::string(trimmed(column.substr(0, column.find('['))));
}

std::string unit_in(std::string_view column) {
  const std::size_t open = column.find('['), close = column.rfind(']');
  if (open == column.npos || close == column.npos || close < open) return "";
  return std::string(trimmed(column.substr(open + 1, close - open - 1)));
}

const Column* Table::find(const std::string& name) const {
  const auto found =
      std::find_if(columns.begin(), columns.end(), [&](const Column& c) { return c.name == name; });
  return found == columns.end() ? nullptr : &*found;
}

Error Table::refusal(std::size_t row, const std::string& what) const {
  return error_at(file, lines.at(row), what).in(reader);
}

Table read_csv(const std::filesystem::path& file, const std::vector<std::string>& required,
               const std::vector<std::string>& optional, const std::string& reader) {
  return on_behalf_of(reader, [&] {
    const TextTable words = read_words(file);
    Table table{{}, {}, file.string(), reader};
    const std::vector<int> places = places_of(required, optional, words, table);
    if (words.rows.empty()) throw error_at(table.file, 1, "no rows, at least one is needed");
    take_numbers(words, places, table);
    return table;
  });
}

Table read_whole_csv(const std::filesystem::path& file, const std::string& reader) {
  return on_behalf_of(reader, [&] {
    const TextTable words = read_words(file);
    Table table{{}, {}, file.string(), reader};
    if (words.rows.empty()) return table;
    std::vector<std::string> names;
    for (const std::string& name : words.head) names.emplace_back(trimmed(name));
    const std::vector<int> places = places_of(names, {}, words, table);
    take_numbers(words, places, table);
    return table;
  });
}

TextTable words_in(const std::string& text, const std::string& file) {
  TextTable table;
  Rows rows(text, file);
  for (std::vector<std::string> row; rows.next(row);) {
    if (table.head.empty()) {
      table.head = std::move(row);
      continue;
    }
    if (row.size() != table.head.size())
      throw error_at(file, rows.line(), fmt::format("{} fields, must be {}", row.size(), table.head.size()));
    table.rows.push_back(std::move(row));
    table.lines.push_back(rows.line());
  }
  return table;
}

TextTable read_words(const std::filesystem::path& file) {
  return words_in(whole_file(file, "cannot read " + file.string()), file.string());
}

void write_csv(const std::filesystem::path& file, const Table& table) {
  std::vector<CsvField> head;
  for (const Column& column : table.columns) head.push_back(column.name);
  AtomicFile target(file.string());
  target.stream() << row_of(head);
  const size_t rows = table.columns.empty() ? 0 : table.columns[0].values.size();
  std::vector<double> numbers(table.columns.size());
  for (size_t r = 0; r < rows; ++r) {
    for (size_t c = 0; c < numbers.size(); ++c) numbers[c] = table.columns[c].values[r];
    target.stream() << exact_row_of(numbers);
  }
  target.commit();
}

std::string number_field(double value) { return std::isfinite(value) ? fmt::format("{:.6g}", value) : ""; }

std::string row_of(const std::vector<CsvField>& fields) {
  std::string row;
  for (std::size_t i = 0; i < fields.size(); ++i) row += (i ? "," : "") + quoted_where_needed(fields[i].text);
  return row + "\n";
}

std::string exact_row_of(const std::vector<double>& numbers) {
  std::string row;
  for (std::size_t i = 0; i < numbers.size(); ++i) row += fmt::format("{}{:.17g}", i ? "," : "", numbers[i]);
  return row + "\n";
}

CsvFile::CsvFile(const std::filesystem::path& file, const std::string& head) : file_(file.string()) {
  file_.stream() << head << '\n';
}

CsvFile::CsvFile(const std::filesystem::path& file, const std::vector<CsvField>& head)
    : file_(file.string()) {
  row(head);
}

}  // namespace hysteron
