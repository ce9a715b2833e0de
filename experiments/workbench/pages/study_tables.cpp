#include "experiments/workbench/pages/study_tables.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "experiments/workbench/pages/page.h"
#include "experiments/workbench/pages/pictures.h"
#include "experiments/workbench/pages/text_table.h"

namespace hysteron::experiments {
namespace {
namespace fs = std::filesystem;

Table table_if_there(const fs::path& file) { return is_there(file) ? read_table(file) : Table{}; }

// Columns that say the same in every row stand above the table.
std::string shown_table(Table table) {
  const std::string common = take_common(table);
  return (common.empty() ? "" : html_about("In all rows " + common)) + text_table_html(table);
}

// "1, 2, 3"; of many the first few and the last.
std::string listed_values(const Json& values) {
  constexpr std::size_t kMax = 16;
  std::string text;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (values.size() > kMax && i >= kMax / 2 && i + 1 < values.size()) continue;
    const bool gap = values.size() > kMax && i + 1 == values.size();
    text += (i ? gap ? ", ..., " : ", " : "") + values[i].get<std::string>();
  }
  return text;
}

}  // namespace

std::string study_keys(const Manifest& manifest) {
  if (!manifest.keys) return "";
  const Json& keys = *manifest.keys;
  std::vector<std::vector<std::string>> rows = {{"experiment", keys.value("experiment", "")}};
  for (const Json& flag : keys.value("shared", Json::array())) {
    const std::string text = flag.get<std::string>();
    const std::size_t equals = text.find('=');
    rows.push_back({text.substr(0, equals), text.substr(equals + 1)});
  }
  for (const Json& axis : keys.value("axes", Json::array()))
    rows.push_back({"axis " + axis.value("key", ""), listed_values(axis.value("values", Json::array()))});
  return html_table({"", ""}, rows, {});
}

std::string study_means(const fs::path& folder) {
  const Table means = table_if_there(folder / "means.csv");
  return means.rows.empty() ? "" : shown_table(means);
}

std::string study_failures(const fs::path& folder) {
  Table table = table_if_there(folder / "table.csv").only({"run", "exit_code", "stopped"});
  std::erase_if(table.rows, [](const auto& row) { return row.back().empty(); });
  return table.rows.empty() ? "" : text_table_html(table);
}

std::string study_runs(const fs::path& folder) {
  Table table = table_if_there(folder / "table.csv");
  if (table.rows.empty()) return "";
  constexpr std::string_view kMean = "_mean";
  std::vector<std::string> columns = {"run"};
  for (const std::string& name : table_if_there(folder / "means.csv").head)
    if (name.ends_with(kMean)) columns.push_back(name.substr(0, name.size() - kMean.size()));
  columns.insert(columns.end(), {"wall_s", "state_hash"});
  constexpr std::size_t kWithoutMeans = 3;
  if (columns.size() > kWithoutMeans) table = table.only(columns);
  return html_details(std::to_string(table.rows.size()) + " runs", shown_table(table),
                      table.rows.size() < 25);
}

}  // namespace hysteron::experiments
