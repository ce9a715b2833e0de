#include "experiments/workbench/compare/comparison_table.h"

#include <algorithm>
#include <cmath>

#include "sim/base/atomic_file.h"
#include "sim/base/csv.h"

namespace hysteron::experiments {
namespace {

bool is_known(const Json& value) { return value.is_number() && std::isfinite(value.get<double>()); }

std::vector<std::string> keys_of(const std::vector<ComparisonRow>& rows) {
  std::vector<std::string> keys;
  for (const ComparisonRow& row : rows)
    for (const auto& [key, value] : row.metrics)
      if (value.is_number() && !std::count(keys.begin(), keys.end(), key)) keys.push_back(key);
  return keys;
}

}  // namespace

void write_comparison_table(Run& run, const std::string& varied, const std::vector<ComparisonRow>& rows) {
  const std::vector<std::string> keys = keys_of(rows);
  std::vector<std::string> head = {varied};
  head.insert(head.end(), keys.begin(), keys.end());
  head.push_back("stopped");
  AtomicFile file(run.path("table.csv").string());
  file.stream() << row_of(head);
  for (const ComparisonRow& row : rows) {
    std::vector<std::string> fields(head.size());
    fields.front() = row.name;
    fields.back() = row.stopped;
    for (const auto& [key, value] : row.metrics) {
      if (!is_known(value)) continue;
      fields[1 + (std::find(keys.begin(), keys.end(), key) - keys.begin())] =
          number_field(value.get<double>());
      run.metric(row.name + "." + key, value);
    }
    file.stream() << row_of(fields);
  }
  file.commit();
}

}  // namespace hysteron::experiments
