#include "sim/base/csv.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <sstream>
#include <string_view>

#include "sim/base/atomic_file.h"
#include "sim/base/error.h"
#include "sim/base/whole_file.h"

namespace hysteron {
namespace {

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view kBlank = " \t\r";
  const size_t first = text.find_first_not_of(kBlank);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlank) - first + 1);
}

std::vector<std::string_view> fields(std::string_view line) {
  std::vector<std::string_view> result;
  for (;;) {
    const size_t comma = line.find(',');
    result.push_back(trimmed(line.substr(0, comma)));
    if (comma == std::string_view::npos) return result;
    line.remove_prefix(comma + 1);
  }
}

std::string without_unit(std::string_view name) {
  return std::string(trimmed(name.substr(0, name.find('['))));
}

// Where something stands in the file, and on whose behalf it is read: "law: loop.csv:3: ".
struct Place {
  std::string reader, file;
  int line = 0;
  Error error(std::string what) const {
    std::replace_if(
        what.begin(), what.end(), [](unsigned char c) { return c < 0x20; }, ' ');  // of the file
    return Error::request(reader + ": " + file + ":" + std::to_string(line) + ": " + what);
  }
};

double number(std::string_view text, const std::string& column, const Place& place) {
  if (!text.empty() && text.front() == '+') text.remove_prefix(1);
  double value = 0;
  const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (failure != std::errc() || end != text.data() + text.size() || !std::isfinite(value))
    throw place.error(column + " = '" + std::string(text) + "' must be a finite number");
  return value;
}

// Index of `wanted` in the header, or -1.  A column of that name in another unit is an error, not an absence.
int position(const std::vector<std::string_view>& header, const std::string& wanted, const Place& place) {
  int found = -1;
  for (size_t i = 0; i < header.size(); ++i) {
    if (without_unit(header[i]) != without_unit(wanted)) continue;
    if (header[i] != wanted)
      throw place.error("column '" + std::string(header[i]) + "' must be called '" + wanted + "'");
    if (found >= 0) throw place.error("column '" + wanted + "' stands twice");
    found = int(i);
  }
  return found;
}

}  // namespace

const Column* Table::find(const std::string& name) const {
  const auto found =
      std::find_if(columns.begin(), columns.end(), [&](const Column& c) { return c.name == name; });
  return found == columns.end() ? nullptr : &*found;
}

Table read_csv(const std::filesystem::path& file, const std::vector<std::string>& required,
               const std::vector<std::string>& optional, const std::string& reader) {
  std::istringstream in(whole_file(file, reader + ": cannot read " + file.string()));
  Place place{reader, file.string(), 1};
  std::string header_line;
  std::getline(in, header_line);
  if (header_line.starts_with("\xEF\xBB\xBF")) header_line.erase(0, 3);
  const std::vector<std::string_view> header = fields(header_line);

  Table table;
  std::vector<int> source;  // column of the file behind each column of the table
  const auto take = [&](const std::string& name, bool needed) {
    const int at = position(header, name, place);
    if (at < 0 && needed)
      throw place.error("column '" + name + "' is missing; the header names it with its unit");
    if (at < 0) return;
    table.columns.push_back({name, {}});
    source.push_back(at);
  };
  for (const std::string& name : required) take(name, true);
  for (const std::string& name : optional) take(name, false);

  for (std::string line; std::getline(in, line);) {
    ++place.line;
    if (trimmed(line).empty()) continue;
    const std::vector<std::string_view> row = fields(line);
    if (row.size() != header.size())
      throw place.error(std::to_string(row.size()) + " fields, must be " + std::to_string(header.size()));
    for (size_t i = 0; i < source.size(); ++i)
      table.columns[i].values.push_back(number(row[size_t(source[i])], table.columns[i].name, place));
    table.lines.push_back(place.line);
  }
  if (table.lines.empty()) throw place.error("no rows, at least one is needed");
  return table;
}

void write_csv(const std::filesystem::path& file, const Table& table) {
  AtomicFile target(file.string());
  std::ostream& out = target.stream();
  out.precision(17);
  for (size_t c = 0; c < table.columns.size(); ++c) out << (c ? "," : "") << table.columns[c].name;
  out << '\n';
  const size_t rows = table.columns.empty() ? 0 : table.columns[0].values.size();
  for (size_t r = 0; r < rows; ++r) {
    for (size_t c = 0; c < table.columns.size(); ++c) out << (c ? "," : "") << table.columns[c].values[r];
    out << '\n';
  }
  target.commit();
}

namespace {

// As a field of a CSV file (RFC 4180).
std::string field(const std::string& text) {
  if (text.find_first_of(",\"\n") == text.npos) return text;
  std::string quoted = "\"";
  for (char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

}  // namespace

std::string row_of(const std::vector<std::string>& fields) {
  std::string row;
  for (std::size_t i = 0; i < fields.size(); ++i) row += (i ? "," : "") + field(fields[i]);
  return row + "\n";
}

std::string number_field(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.6g", value);
  return std::isfinite(value) ? text : "";
}

}  // namespace hysteron
