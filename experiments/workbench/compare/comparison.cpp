#include "experiments/workbench/compare/comparison.h"

#include <algorithm>
#include <utility>

#include "sim/base/csv.h"
#include "sim/base/error.h"
#include "sim/scene/key_table.h"

namespace hysteron::experiments {
namespace {

bool is_numeric(const MetricValue& value) { return value.is_numeric(); }

Cell metric_field(const MetricValue& value) {
  if (value.is_text()) return value.text();
  return value.is_number() ? Cell(value.number()) : Cell("");
}

constexpr std::size_t kMaxTexts = 20, kMaxNames = 4;

// Returns "linear, dahl, kim, wong and 3 others".
std::string listed_names(const std::vector<std::string>& names) {
  if (names.size() <= kMaxNames) return join(names, ", ");
  const std::vector<std::string> first(names.begin(), names.begin() + kMaxNames);
  const std::size_t others = names.size() - kMaxNames;
  return join(first, ", ") + " and " + std::to_string(others) + (others == 1 ? " other" : " others");
}

void warn_of_missing(Run& run, const ChildRun& column, const std::vector<std::string>& metrics) {
  for (const std::string& name : metrics)
    if (!column.metrics().contains(name))
      run.warn("compare.metrics: " + column.name + " has found no " + name + " (--compare.metrics)");
}

}  // namespace

void ColumnWarnings::add(const ChildRun& column) {
  if (column.manifest) add(column.name, column.manifest->warnings);
  if (!column.stopped.empty()) add(column.name, {column.stopped});
}

void ColumnWarnings::add(const std::string& name, const std::vector<std::string>& texts) {
  for (const std::string& text : texts) {
    auto known = std::find_if(heard_.begin(), heard_.end(), [&](const Heard& h) { return h.text == text; });
    if (known == heard_.end()) known = heard_.insert(heard_.end(), {text, {}});
    known->names.push_back(name);
  }
}

void ColumnWarnings::emit(Run& run) const {
  for (std::size_t i = 0; i < std::min(heard_.size(), kMaxTexts); ++i)
    run.warn(listed_names(heard_[i].names) + ": " + heard_[i].text);
  if (heard_.size() > kMaxTexts)
    run.warn("the runs give " + std::to_string(heard_.size() - kMaxTexts) +
             " more warnings, each in the manifest of its run");
}

std::vector<std::string> metrics_in(const std::vector<ChildRun>& columns,
                                    bool (*wanted)(const MetricValue&)) {
  std::vector<std::string> keys;
  for (const ChildRun& column : columns)
    for (const auto& [key, value] : column.metrics())
      if (wanted(value) && !std::count(keys.begin(), keys.end(), key)) keys.push_back(key);
  return keys;
}

void run_columns(Run& run, std::vector<ChildRun>& columns, const SweepJobs& jobs,
                 const std::vector<std::string>& metrics) {
  for (const ChildRun& column : columns) run.add_part(column.folder, jobs.resume);
  bool none_complete = true;
  run_columns(
      columns, jobs,
      [&](const ChildRun& c) {
        run.progress(c.name + ": " + run_outcome(c));
        if (c.stopped.empty() && std::exchange(none_complete, false)) warn_of_missing(run, c, metrics);
      },
      [&](const std::string& line) { run.progress(line); });
  run.keep_from_here();
  ColumnWarnings warnings;
  for (const ChildRun& column : columns) warnings.add(column);
  warnings.emit(run);
}

void write_comparison_table(Run& run, const std::string& varied, const std::vector<ChildRun>& columns,
                            const std::vector<std::string>& metrics) {
  const std::vector<std::string> keys = metrics.empty() ? metrics_in(columns, is_numeric) : metrics;
  const std::vector<std::string> named =
      metrics.empty() ? metrics_in(columns, [](const MetricValue& v) { return v.is_number() || v.is_text(); })
                      : metrics;
  Table table(std::vector{varied});
  table.head.insert(table.head.end(), keys.begin(), keys.end());
  table.head.push_back("stopped");
  for (const ChildRun& column : columns) {
    const Metrics found = column.metrics();
    if (column.manifest) run.manifest().requested_metrics = column.manifest->requested_metrics;
    std::vector<Cell> fields = {column.name};
    for (const std::string& key : keys) fields.push_back(metric_field(found[key]));
    for (const std::string& key : named)
      if (found[key].is_number() || found[key].is_text()) run.metric(column.name + "." + key, found[key]);
    fields.push_back(column.stopped);
    table.row(fields);
  }
  table.write(run.path("table.csv"));
}

}  // namespace hysteron::experiments
