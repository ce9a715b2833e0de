#include "experiments/workbench/compare/comparison_table.h"

#include <algorithm>

#include "sim/base/csv.h"

namespace hysteron::experiments {
namespace {

std::vector<std::string> keys_of(const std::vector<ComparisonRow>& rows) {
  std::vector<std::string> keys;
  for (const ComparisonRow& row : rows)
    for (const auto& [key, value] : row.metrics)
      if (value.is_numeric() && !std::count(keys.begin(), keys.end(), key)) keys.push_back(key);
  return keys;
}

}  // namespace

void write_comparison_table(Run& run, const std::string& varied, const std::vector<ComparisonRow>& rows) {
  const std::vector<std::string> keys = keys_of(rows);
  std::vector<CsvField> head = {varied};
  head.insert(head.end(), keys.begin(), keys.end());
  head.push_back("stopped");
  CsvFile file(run.path("table.csv"), head);
  for (const ComparisonRow& row : rows) {
    std::vector<CsvField> fields(head.size(), "");
    fields.front() = row.name;
    fields.back() = row.stopped;
    for (const auto& [key, value] : row.metrics) {
      if (!value.is_number()) continue;
      fields[1 + (std::find(keys.begin(), keys.end(), key) - keys.begin())] = value.number();
      run.metric(row.name + "." + key, value);
    }
    file.row(fields);
  }
  file.commit();
}

}  // namespace hysteron::experiments
