#include "experiments/workbench/compare/comparison.h"

#include <algorithm>

#include "sim/base/csv.h"

namespace hysteron::experiments {
namespace {

std::vector<std::string> numbers_in(const std::vector<SweepColumn>& columns) {
  std::vector<std::string> keys;
  for (const SweepColumn& column : columns)
    for (const auto& [key, value] : column.metrics())
      if (value.is_numeric() && !std::count(keys.begin(), keys.end(), key)) keys.push_back(key);
  return keys;
}

}  // namespace

void run_comparison(Run& run, const std::string& varied, std::vector<SweepColumn>& columns,
                    const SweepJobs& jobs, const std::vector<std::string>& metrics) {
  run_columns(
      columns, jobs, [&](const SweepColumn& c) { run.progress(c.name + ": " + outcome_of(c)); },
      [&](const std::string& line) { run.progress(line); });
  write_comparison_table(run, varied, columns, metrics);
}

void write_comparison_table(Run& run, const std::string& varied, const std::vector<SweepColumn>& columns,
                            const std::vector<std::string>& metrics) {
  const std::vector<std::string> keys = metrics.empty() ? numbers_in(columns) : metrics;
  std::vector<CsvField> head = {varied};
  head.insert(head.end(), keys.begin(), keys.end());
  head.push_back("stopped");
  CsvFile file(run.path("table.csv"), head);
  for (const SweepColumn& column : columns) {
    const Metrics found = column.metrics();
    if (column.manifest) run.manifest().asked_metrics = column.manifest->asked_metrics;
    std::vector<CsvField> fields = {column.name};
    for (const std::string& key : keys) {
      fields.push_back(found[key].is_number() ? CsvField(found[key].number()) : CsvField(""));
      if (found[key].is_number()) run.metric(column.name + "." + key, found[key]);
    }
    fields.push_back(column.stopped);
    file.row(fields);
  }
  file.commit();
}

}  // namespace hysteron::experiments
