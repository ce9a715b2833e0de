#include <cstdlib>
#include <limits>
#include <sstream>

#include "render/plot.h"
#include "sim/base/error.h"
#include "sim/base/whole_file.h"

namespace hysteron::render {
namespace {

std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells(1);
  for (const char c : line) {
    if (c == ',')
      cells.emplace_back();
    else if (c != '\r')
      cells.back() += c;
  }
  return cells;
}

size_t column_named(const std::vector<std::string>& names, const std::string& wanted,
                    const std::string& file) {
  std::string all;
  for (size_t i = 0; i < names.size(); ++i) {
    if (names[i] == wanted || names[i].substr(0, names[i].find(" [")) == wanted) return i;
    all += (i ? ", " : "") + names[i];
  }
  throw Error::request("reading " + file + ": no column \"" + wanted + "\"; there are: " + all);
}

double number_in(const std::vector<std::string>& cells, size_t column, const std::string& file, int line) {
  if (column >= cells.size() || cells[column].empty()) return std::numeric_limits<double>::quiet_NaN();
  char* end = nullptr;
  const double value = std::strtod(cells[column].c_str(), &end);
  if (*end != '\0')
    throw Error::request("reading " + file + ":" + std::to_string(line) + ": \"" + cells[column] +
                         "\" is no number");
  return value;
}

}  // namespace

Series series_from_csv(const std::filesystem::path& csv, const std::string& x, const std::string& y,
                       const std::string& label) {
  std::istringstream file(file_named(csv, "reading " + csv.string()));
  std::string line;
  if (!std::getline(file, line)) throw Error::request("reading " + csv.string() + ": the file is empty");
  const auto names = cells_of(line);
  const size_t x_column = column_named(names, x, csv.string()),
               y_column = column_named(names, y, csv.string());
  Series series{.label = label, .x = {}, .y = {}};
  for (int number = 2; std::getline(file, line); ++number) {
    if (line.empty()) continue;
    const auto cells = cells_of(line);
    series.x.push_back(number_in(cells, x_column, csv.string(), number));
    series.y.push_back(number_in(cells, y_column, csv.string(), number));
  }
  return series;
}

}  // namespace hysteron::render
