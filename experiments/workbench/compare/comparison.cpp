#include "experiments/workbench/compare/comparison.h"

#include <algorithm>

#include "experiments/workbench/compare/column_warnings.h"
#include "sim/base/csv.h"
#include "sim/base/error.h"
#include "sim/scene/key_table.h"

namespace hysteron::experiments {
namespace {

bool is_numeric(const MetricValue& value) { return value.is_numeric(); }
bool is_number_or_text(const MetricValue& value) { return value.is_numeric() || value.is_text(); }

Cell metric_field(const MetricValue& value) {
  if (value.is_text()) return value.text();
  return value.is_number() ? Cell(value.number()) : Cell("");
}

}  // namespace

std::vector<std::string> metrics_in(const std::vector<ChildRun>& columns,
                                    bool (*wanted)(const MetricValue&)) {
  std::vector<std::string> keys;
  for (const ChildRun& column : columns)
    for (const auto& [key, value] : column.metrics())
      if (wanted(value) && !std::count(keys.begin(), keys.end(), key)) keys.push_back(key);
  return keys;
}

void run_columns(Run& run, std::vector<ChildRun>& columns, const SweepJobs& jobs) {
  run_columns(
      columns, jobs, [&](const ChildRun& c) { run.progress(c.name + ": " + run_outcome(c)); },
      [&](const std::string& line) { run.progress(line); });
  ColumnWarnings warnings;
  for (const ChildRun& column : columns) warnings.hear(column);
  warnings.say(run);
}

void check_metrics(const std::vector<ChildRun>& columns, const std::vector<std::string>& names) {
  if (std::none_of(columns.begin(), columns.end(), [](const ChildRun& c) { return c.stopped.empty(); }))
    return;
  const std::vector<std::string> known = metrics_in(columns, is_number_or_text);
  for (const std::string& name : names)
    if (!std::count(known.begin(), known.end(), name))
      throw Error::invalid_input("compare.metrics = " + name + " must be among " + join(known, ", ") +
                                 "; --resume keeps the columns that have run (--compare.metrics)")
          .with_key("compare.metrics", name);
}

void write_comparison_table(Run& run, const std::string& varied, const std::vector<ChildRun>& columns,
                            const std::vector<std::string>& metrics) {
  const std::vector<std::string> keys = metrics.empty() ? metrics_in(columns, is_numeric) : metrics;
  Table table(std::vector{varied});
  table.head.insert(table.head.end(), keys.begin(), keys.end());
  table.head.push_back("stopped");
  for (const ChildRun& column : columns) {
    const Metrics found = column.metrics();
    if (column.manifest) run.manifest().requested_metrics = column.manifest->requested_metrics;
    std::vector<Cell> fields = {column.name};
    for (const std::string& key : keys) {
      fields.push_back(metric_field(found[key]));
      if (found[key].is_number() || found[key].is_text()) run.metric(column.name + "." + key, found[key]);
    }
    fields.push_back(column.stopped);
    table.row(fields);
  }
  table.write(run.path("table.csv"));
}

}  // namespace hysteron::experiments
