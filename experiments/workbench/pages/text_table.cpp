#include "experiments/workbench/pages/text_table.h"

#include <algorithm>

#include "experiments/workbench/pages/manifest.h"
#include "experiments/workbench/pages/page.h"
#include "sim/base/number_in.h"

namespace hysteron::experiments {
namespace {

// Shortens a number to six significant digits; other texts stay.
std::string short_field(const std::string& text) {
  if (text.find_first_of(".e") == text.npos || text.size() < 8) return text;
  const std::optional<double> value = number_in(text);
  return value ? number_field(*value) : text;
}

bool numeric(const Table& table, std::size_t column) {
  bool any = false;
  for (const auto& row : table.rows) {
    if (row[column].empty()) continue;
    if (!number_in(row[column])) return false;
    any = true;
  }
  return any;
}

bool same_everywhere(const Table& table, std::size_t column) {
  return std::all_of(table.rows.begin(), table.rows.end(),
                     [&](const auto& row) { return row[column] == table.rows[0][column]; });
}

// Returns "set curvature [1/m]" for both "set_curvature_per_m" and "set_curvature [1/m]".
std::string column_name(std::string name) {
  if (name.find('[') == name.npos) return split_unit(name).text();
  std::replace(name.begin(), name.end(), '_', ' ');
  return name;
}

}  // namespace

std::string take_common(Table& table) {
  std::string common;
  if (table.rows.size() < 2) return common;
  for (std::size_t c = table.head.size(); c-- > 0;) {
    if (!same_everywhere(table, c)) continue;
    const std::string value = table.rows[0][c];
    if (!value.empty()) {
      common = column_name(table.head[c]) + ": " + short_field(value) + (common.empty() ? "" : ", ") + common;
    }
    table.head.erase(table.head.begin() + static_cast<std::ptrdiff_t>(c));
    for (auto& row : table.rows) row.erase(row.begin() + static_cast<std::ptrdiff_t>(c));
  }
  return common;
}

std::string text_table_html(const Table& table) {
  std::vector<std::string> head;
  std::vector<std::size_t> right;
  for (std::size_t c = 0; c < table.head.size(); ++c) {
    head.push_back(column_name(table.head[c]));
    if (numeric(table, c)) right.push_back(c);
  }
  std::vector<std::vector<std::string>> rows = table.rows;
  for (auto& row : rows) std::transform(row.begin(), row.end(), row.begin(), short_field);
  return html_table(head, rows, right);
}

}  // namespace hysteron::experiments
