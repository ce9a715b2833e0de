#include <fmt/core.h>

#include <algorithm>
#include <cstdlib>
#include <limits>

#include "render/plot.h"
#include "sim/base/csv.h"
#include "sim/base/whole_file.h"

namespace hysteron::render {
namespace {

size_t column_named(const std::vector<std::string>& names, const std::string& wanted,
                    const std::string& attempt) {
  std::string all;
  for (size_t i = 0; i < names.size(); ++i) {
    if (names[i] == wanted || names[i].substr(0, names[i].find(" [")) == wanted) return i;
    all += (i ? ", " : "") + names[i];
  }
  throw Error::invalid_input(fmt::format("{}: no column \"{}\"; there are: {}", attempt, wanted, all));
}

double number_in(const std::string& cell, const std::string& attempt, int line) {
  if (cell.empty()) return std::numeric_limits<double>::quiet_NaN();
  char* end = nullptr;
  const double value = std::strtod(cell.c_str(), &end);
  if (*end != '\0')
    throw Error::invalid_input(fmt::format("{}:{}: \"{}\" is no number", attempt, line, cell));
  return value;
}

}  // namespace

Series series_from_csv(const std::filesystem::path& csv, const std::string& x, const std::string& y,
                       const std::string& label) {
  const std::string attempt = "reading " + csv.string();
  const Table table = table_in(file_named(csv, attempt), csv.string());
  if (table.head.empty()) throw Error::invalid_input(attempt + ": the file is empty");
  const size_t x_column = column_named(table.head, x, attempt),
               y_column = column_named(table.head, y, attempt);
  Series series{.label = label, .x = {}, .y = {}};
  for (size_t r = 0; r < table.rows.size(); ++r) {
    series.x.push_back(number_in(table.rows[r][x_column], attempt, table.lines[r]));
    series.y.push_back(number_in(table.rows[r][y_column], attempt, table.lines[r]));
  }
  return series;
}

}  // namespace hysteron::render
