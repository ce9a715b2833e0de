#include "sim/reference/tester_table.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "sim/base/number_in.h"
#include "sim/base/whole_file.h"

namespace hysteron {
namespace {

std::string trimmed(std::string text) {
  const auto is_blank = [](unsigned char c) { return std::isspace(c) || c == '"'; };
  while (!text.empty() && is_blank(text.back())) text.pop_back();
  while (!text.empty() && is_blank(text.front())) text.erase(text.begin());
  return text;
}

bool same_words(const std::string& a, const std::string& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](unsigned char x, unsigned char y) { return std::tolower(x) == std::tolower(y); });
}

char separator_of(const std::string& line) {
  for (const char separator : {';', '\t'})
    if (line.find(separator) != std::string::npos) return separator;
  return ',';
}

std::vector<std::string> fields_of(const std::string& line, char separator) {
  std::vector<std::string> fields;
  std::istringstream rest(line);
  for (std::string field; std::getline(rest, field, separator);) fields.push_back(trimmed(field));
  if (!line.empty() && line.back() == separator) fields.emplace_back();
  return fields;
}

}  // namespace

TextTable read_tester_table(const std::filesystem::path& file, const std::string& first_column,
                            const std::string& reader) {
  std::string text = whole_file(file, "cannot read " + file.string());
  if (text.starts_with("\xEF\xBB\xBF")) text.erase(0, 3);
  std::istringstream lines(text);
  TextTable table;
  char separator = ',';
  int number = 0;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    if (trimmed(line).empty()) continue;
    if (table.head.empty()) {
      separator = separator_of(line);
      const std::vector<std::string> fields = fields_of(line, separator);
      const bool is_head = std::any_of(fields.begin(), fields.end(), [&](const std::string& field) {
        return same_words(field, first_column);
      });
      if (is_head) table.head = fields;
      continue;
    }
    std::vector<std::string> fields = fields_of(line, separator);
    const std::string at = file.filename().string() + ":" + std::to_string(number);
    if (fields.size() != table.head.size())
      throw Error::request(at + " has " + std::to_string(fields.size()) + " fields, its head has " +
                           std::to_string(table.head.size()))
          .in(reader);
    if (separator != ',')
      for (std::string& field : fields) std::replace(field.begin(), field.end(), ',', '.');
    table.rows.push_back(std::move(fields));
    table.lines.push_back(number);
  }
  if (table.head.empty())
    throw Error::request(file.filename().string() + " has no line that names a column " + first_column +
                         ": another table, or other units than said (--units)")
        .in(reader);
  if (table.rows.empty()) throw Error::request(file.filename().string() + " has no rows").in(reader);
  return table;
}

double number_of(const TextTable& table, std::size_t row, std::size_t column,
                 const std::filesystem::path& file, const std::string& reader) {
  const std::string& field = table.rows[row][column];
  const auto number = number_in(field);
  if (!number || !std::isfinite(*number))
    throw Error::request(file.filename().string() + ":" + std::to_string(table.lines[row]) + ": " +
                         table.head[column] + " = \"" + field + "\" must be a finite number")
        .in(reader);
  return *number;
}

}  // namespace hysteron
